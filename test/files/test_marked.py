"""Values of a file: their types, and errors with and without a word of it."""

from __future__ import annotations

from math import inf, nan

import pytest

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.files.marked import Marked, quoted


def marked(value):
    items = [marked(item) for item in value] if isinstance(value, list) else None
    return Marked('f', 3, 4, value, None, items)


@pytest.mark.parametrize(
    ('value', 'kind', 'found'),
    [(1, float, 1.0), (-2.5, float, -2.5), (7, int, 7), (True, bool, True), ('a', str, 'a')],
)
def test_a_value_of_its_type(value, kind, found):
    typed = marked(value).typed('x', kind)
    assert (typed, type(typed)) == (found, kind)


@pytest.mark.parametrize(
    ('value', 'kind', 'reason'),
    [
        (True, float, 'x = True: expected a number'),
        ('1', float, "x = '1': expected a number"),
        (None, float, 'x = None: expected a number'),
        (nan, float, 'x = nan: must be a finite number'),
        (-inf, float, 'x = -inf: must be a finite number'),
        (10**309, float, 'x = inf: must be a finite number'),
        (2**63, int, 'expected a whole number of 64 bits'),
        (1.0, int, 'x = 1.0: expected a whole number'),
        (1, bool, 'x = 1: expected true or false'),
        (1, str, 'x = 1: expected text'),
    ],
)
def test_a_value_of_another_type_is_refused(value, kind, reason):
    with pytest.raises(ConfigurationError) as caught:
        marked(value).typed('x', kind)
    assert str(caught.value).startswith('f, line 3, column 4: ')
    assert reason in str(caught.value)


def test_over_the_network_no_word_of_the_file_is_told():
    for refuse in (
        lambda: marked('secret').typed('x', float),
        lambda: marked('secret').mapping('x'),
        lambda: marked('secret').items('x'),
        lambda: marked(['secret', 1]).point('x'),
        lambda: marked(['secret']).point('x'),
        lambda: marked('x').refuse('secret'),
    ):
        with pytest.raises(ConfigurationError, match='secret') as caught:
            refuse()
        assert 'secret' not in caught.value.unquoted
        assert caught.value.unquoted.startswith('f, line 3, column 4: ')
        assert caught.value.file == 'f'


def test_an_error_may_be_of_another_kind():
    with pytest.raises(GeometryError, match='line 3, column 4: no zone'):
        marked(1).refuse('no zone', kind=GeometryError)


def test_a_quotation_is_short():
    assert len(quoted('x' * 10**6)) < 100
    assert len(quoted([[['x' * 100] * 100] * 100] * 100)) <= 200
