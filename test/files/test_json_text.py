"""JSON within limits: the same values as Python's own reader, or an error with its place."""

from __future__ import annotations

import json
import time
from contextlib import suppress

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.files import json_text

VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**30), 10**30) | st.floats(allow_nan=False)
    | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=20,
)  # fmt: skip


@settings(max_examples=50)
@given(VALUES, st.sampled_from([None, 0, 3, '\t']))
def test_the_same_as_pythons_own(value, indent):
    assert json_text.parse(json.dumps(value, indent=indent), 'f').value == value


@pytest.mark.parametrize(
    ('text', 'where', 'reason'),
    [
        ('[' * 100_000, '1:65', 'nested more than 64 deep'),
        ('{"a":' * 3000, '1:321', 'nested more than 64 deep'),
        ('[1,\n ' + '9' * 400 + ']', '2:2', 'a number of 400 characters'),
        ('[' + '1,' * 60_000 + '1]', '1:100000', 'more than 50000 values'),
        ('{"a": 1, "a": 2}', '1:10', "'a' stands twice"),
        ('[1,]', '1:4', "expected a value, got ']'"),
        ('[1 2]', '1:4', "expected ',', got '2]'"),
        ('{"a" 1}', '1:6', "expected ':', got '1}'"),
        ('{a: 1}', '1:2', 'expected text in double quotes'),
        ('"\\ud800"', '1:1', 'an escape that is none'),
        ('"\\q"', '1:1', 'an escape that is none'),
        ('"a\nb"', '1:1', 'expected text in double quotes'),
        ('01', '1:2', 'expected the end of the file'),
        ('', '1:1', 'expected a value, got the end'),
    ],
)
def test_what_is_refused_and_where(text, where, reason):
    line, column = where.split(':')
    begun = time.process_time()
    with pytest.raises(ConfigurationError) as caught:
        json_text.parse(text, 'f.json')
    assert time.process_time() - begun < 1.0
    assert str(caught.value).startswith(f'f.json, line {line}, column {column}: ')
    assert reason in str(caught.value)


@given(st.text(st.sampled_from('[]{},:"\\ \n\ttrue1.0eE+-u0N\x00é\ud800'), max_size=40))
def test_any_text_is_read_or_refused(text):
    with suppress(ConfigurationError):
        json_text.parse(text, 'f')
