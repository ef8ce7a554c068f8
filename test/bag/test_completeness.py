"""How complete a recording is: sums over files and topics, and never 100 % where one is missing."""

from __future__ import annotations

import pytest

from agv_motion.bag.completeness import (
    NAME,
    Completeness,
    as_record,
    of_records,
    together,
)
from agv_motion.bag.mcap.records import Metadata


@pytest.mark.parametrize(('one', 'text'), [
    (Completeness(), '100 % complete'), (Completeness(5), '100 % complete'),
    (Completeness(9998, 1, 1), '99.98 % complete (1 lost on the way, 1 dropped)'),
    (Completeness(10**17, 1), '99.99 % complete (1 lost on the way, 0 dropped)'),
    (Completeness(10**9, 1), '99.99 % complete (1 lost on the way, 0 dropped)'),
    (Completeness(0, 0, 3), '0.00 % complete (0 lost on the way, 3 dropped)'),
])  # fmt: skip
def test_as_a_person_reads_it(one, text):
    assert str(one) == text


def test_records_of_several_files_are_added():
    files = [as_record({'/a': Completeness(10, 1, 0), '/b': Completeness(5)}),
             Metadata('other', {'/a': 'x'}), as_record({'/a': Completeness(20, 0, 2)})]  # fmt: skip
    found = of_records(files)
    assert found == {'/a': Completeness(30, 1, 2), '/b': Completeness(5)}
    assert together(found) == Completeness(35, 1, 2)
    assert together({}) == Completeness()
    assert of_records([Metadata('other', files[0].entries)]) == {}
    assert (Completeness().share, Completeness(3, 1, 0).share) == (1.0, 0.75)
    assert Completeness(0, 2, 3).missing == 5


@pytest.mark.parametrize('text', [
    '', 'x', '5', '{}', '{"recorded": 1, "lost": 1}', '[' * 100_000,
    '{"recorded": -1, "lost": 0, "dropped": 0}', '{"recorded": 1.5, "lost": 0, "dropped": 0}',
    '{"recorded": true, "lost": 0, "dropped": 0}', '{"recorded": 1e99, "lost": 0, "dropped": 0}',
])  # fmt: skip
def test_what_cannot_be_is_passed_over(text):
    assert of_records([Metadata(NAME, {'/a': text})]) == {}


def test_what_is_new_is_never_negative():
    assert Completeness(5, 1, 3).since(Completeness(2, 2, 0)) == Completeness(3, 0, 3)
