"""YAML within limits: what plain scalars mean, and that nothing hangs or ends the program."""

from __future__ import annotations

import time
from contextlib import suppress
from math import inf, isnan

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.files import yaml_text

NINE = 'a: &a [x,x,x,x,x,x,x,x,x]\n' + ''.join(
    f'{new}: &{new} [{",".join([f"*{old}"] * 9)}]\n'
    for old, new in zip('abcdefg', 'bcdefgh', strict=False)
)
"""9 to the 8th values of 9 that stand there."""
WRITTEN = st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text()


def test_what_plain_scalars_mean():
    assert yaml_text.plain('[1, -2.5, 1e3, -.inf, yes, ~, "1", 2020-01-01, 0x10, {a: b}]', 'f') == [
        1,
        -2.5,
        1000.0,
        -inf,
        True,
        None,
        '1',
        '2020-01-01',
        16,
        {'a': 'b'},
    ]
    assert isnan(yaml_text.plain('.nan', 'f'))
    assert yaml_text.plain('# nothing\n', 'f') is None


def test_a_long_scalar_is_looked_at_once():
    begun = time.process_time()
    text = '9' * 200_000 + 'x'
    assert yaml_text.plain(text, 'f') == text
    assert time.process_time() - begun < 1.0


def test_an_alias_repeats_what_came_before():
    assert yaml_text.plain('a: &x [1, 2]\nb: *x', 'f') == {'a': [1, 2], 'b': [1, 2]}


@pytest.mark.parametrize(
    ('text', 'where', 'reason'),
    [
        (NINE, '5:23', 'more than 50000 values'),
        ('a: &x [*x]', '1:8', 'an alias of nothing that came before'),
        ('[' * 100_000, '1:1001', 'nest'),
        ('- ' * 100_000, '1:129', 'nested more than 64 deep'),
        ('{a: ' * 500, '1:257', 'nested more than 64 deep'),
        ('a: ' + '9' * 400, '1:4', 'a number of 400 characters'),
        ('a: -0.' + '9' * 5000, '1:4', 'a number of 5003 characters'),
        ('a: 0x_', '1:4', "'0x_' is no whole number"),
        ('a: !!int x', '1:4', 'is no whole number'),
        ('a: !!float ""', '1:4', 'is no number'),
        ('a: !!bool maybe', '1:4', 'is neither true nor false'),
        ('a: !!python/object:os.system [x]', '1:4', 'a tag that is not known here'),
        ('a: !!set {x}', '1:4', 'a tag that is not known here'),
        ('a: 1\n---\nb: 2', '2:1', 'a second document begins'),
        ('a: 1\nb: 2\na: 3', '3:1', "'a' stands twice"),
        ('? [1]\n: 2', '1:3', 'a mapping or list cannot be a key'),
        ('a:\n\t- 1', '2:1', 'a tab stands here; indent by blanks'),
        ('a: \x00', '1:4', 'a control character (0x00)'),
        ('a: \ud800', '1:4', 'a control character (0xd800)'),
        ('a: "\\ud800"', '1:7', 'no YAML'),
    ],
)
def test_what_is_refused_and_where(text, where, reason):
    line, column = where.split(':')
    begun = time.process_time()
    with pytest.raises(ConfigurationError) as caught:
        yaml_text.plain(text, 'f.yaml')
    assert time.process_time() - begun < 1.0
    assert str(caught.value).startswith(f'f.yaml, line {line}, column {column}: ')
    assert reason in str(caught.value)
    assert caught.value.unquoted.startswith(f'f.yaml, line {line}, column {column}: ')


@given(st.text(st.sampled_from('[]{}&*!|>%@#-:, \n\t"\'\\ab1.0e~?<=_\x00é\ud800'), max_size=60))
def test_any_text_is_read_or_refused(text):
    with suppress(ConfigurationError):
        yaml_text.plain(text, 'f')


def test_a_file_is_named_and_an_empty_one_is_told(tmp_path):
    path = tmp_path / 'f.yaml'
    path.write_text('\ufeffa: 1')
    content = yaml_text.load(path)
    assert content.value == {'a': 1}
    assert content.mapping('it')['a'][1].where == f'{path}, line 1, column 4'
    path.write_text('\n')
    with pytest.raises(ConfigurationError, match=r'f\.yaml: the file is empty'):
        yaml_text.load(path)


@settings(max_examples=20)
@given(st.lists(st.dictionaries(st.text(), WRITTEN, max_size=3), max_size=3))
def test_what_is_written_is_read_back(content):
    assert yaml.safe_load(yaml_text.dump(content)) == content


def test_entries_stay_in_order():
    assert yaml_text.dump({'b': [1, {'c': None}], 'a': 'x'}) == 'b:\n- 1\n- c: null\na: x\n'
