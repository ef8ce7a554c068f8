"""JSON objects of loggers: what is named is read, nothing is guessed."""

from __future__ import annotations

from math import isnan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.probe.sources.json_line import read_json
from agv_motion.probe.sources.line_reading import LineParameters, read_line_of, sample_of

NOON = 1370865600.0
"""[s] since 1970, of 10 June 2013, 12:00 UTC"""
GIVEN = LineParameters(format='json', json_keys=('a', 'air.vpd', 'p.1'), unit='K')


def parse_line(text, given, now=0.0):
    return sample_of(text, read_line_of(text, given, now), given)


def test_members_are_found_by_name_whatever_their_order():
    told = (
        '{"p": [7, 19.5], "air": {"vpd": "0.8"}, "b": true, "time": "2013-06-10T12:00:00Z", "a":18}'
    )
    sample = parse_line(told, GIVEN)
    assert (sample.time, sample.values) == (NOON, (18.0, 0.8, 19.5))


@pytest.mark.parametrize(
    'value', ['null', 'true', '"x"', 'NaN', 'Infinity', '-Infinity', '1e999', '-9999', '[1]']
)
def test_what_is_no_number_is_no_value(value):
    _, values = read_json(f'{{"a": {value}, "b": 1}}', ('a', 'b'), '')
    assert isnan(values[0])
    assert values[1] == 1.0


@pytest.mark.parametrize(
    ('text', 'word'),
    [
        ('{"a": 1}', "no member 'b', only a: give json_keys"),
        ('{"b": 1, "b": 2}', 'stands in it twice'),
        ('[1, 2]', 'no object'),
        ('17.5', 'no object'),
        ('{"b": 1', 'no JSON object'),
        ('[' * 100_000, 'no JSON object'),
        ('{"b": 1, "t": {}}', "'t' is no time"),
        ('{"b": 1, "t": null}', "'t' is no time"),
    ],
)
def test_what_is_no_such_object_is_refused(text, word):
    with pytest.raises(SignalError, match=word):
        read_json(text, ('b',), 't' if '"t"' in text else '')


@pytest.mark.parametrize(
    ('name', 'word'),
    [('epoch_s', '1370865600'), ('epoch_ms', '1370865600000'), ('YYYYMMDDHHMM', '201306101200')],
)
def test_a_number_is_a_time_where_its_format_is_named(name, word):
    text = f'{{"time": {word}, "a": 1}}'
    keys = {'json_keys': ('a',), 'fields': (1,), 'format': 'json'}
    assert parse_line(text, LineParameters(**keys, time_format=name)).time == NOON
    with pytest.raises(SignalError, match='see time_format'):
        parse_line(text, LineParameters(**keys))


def test_the_time_may_be_that_of_the_arrival():
    alone = LineParameters(format='json', json_keys=('a',), fields=(1,), json_time='')
    assert not alone.stamped
    assert GIVEN.stamped
    assert parse_line('{"a": 1}', alone, NOON).time == NOON


def test_each_field_has_a_member():
    with pytest.raises(ConfigurationError, match='name a member for each field up to 3'):
        LineParameters(format='json', json_keys=('a', 'b'))


@settings(deadline=None, max_examples=60)
@given(some.text(max_size=20), some.booleans())
def test_any_text_is_read_or_refused(word, within):
    text = f'{{"a": {word}}}' if within else word
    try:
        _, values = read_json(text, ('a',), '')
    except SignalError:
        return
    assert all(isnan(value) or abs(value) < 1e308 for value in values)
