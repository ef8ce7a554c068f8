"""Profiles as rosbag2 keeps them: words or numbers, of any version."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.bag.quality_of_service import (
    FOREVER,
    WORDS,
    OfferedQos,
    as_yaml,
    kept,
    nanoseconds,
)

PROFILES = st.builds(
    OfferedQos, st.integers(0, 1000),
    *(st.sampled_from(WORDS[key]) for key in ('reliability', 'durability', 'history',
                                              'liveliness')),
    *[st.integers(1, FOREVER)] * 3,
)  # fmt: skip


@settings(max_examples=40)
@given(st.lists(PROFILES, max_size=3))
def test_what_is_written_is_read(profiles):
    assert OfferedQos.from_yaml(as_yaml(profiles)) == tuple(profiles)


def test_what_is_not_told_is_as_ros_has_it():
    assert OfferedQos.from_entries({}) == OfferedQos(depth=10)


def test_older_bags_wrote_numbers():
    found = OfferedQos.from_entries(
        {'history': 3, 'depth': 5, 'reliability': 2, 'durability': 1, 'liveliness': 1,
         'deadline': {'sec': 0, 'nsec': 0}, 'lifespan': {'sec': 2, 'nsec': 3}}
    )  # fmt: skip
    assert found == OfferedQos(
        5, 'best_effort', 'transient_local', 'unknown', 'automatic', FOREVER, 2_000_000_003
    )


@pytest.mark.parametrize(
    'wrong', ['', 'x', '- 7', '- depth: many', '- deadline: 3', '- history: 99', '- depth: .inf',
              '{', '- {depth: 1}: 2'],
)  # fmt: skip
def test_what_is_no_profile_counts_as_not_given(wrong):
    assert OfferedQos.from_yaml(wrong) == ()


def test_latched_publishers_keep_their_depth():
    latched = OfferedQos(3, durability='transient_local')
    assert kept([latched, OfferedQos(100), latched._replace(depth=0)]) == 4
    assert kept([]) == 0


@pytest.mark.parametrize(
    ('time', 'ns'),
    [
        ({'sec': 0, 'nsec': 0}, FOREVER), ({'sec': 1, 'nsec': 5}, 1_000_000_005),
        ({'sec': 2**40, 'nsec': 0}, FOREVER), ({'sec': 9223372036, 'nsec': 854775807}, FOREVER),
    ],
)  # fmt: skip
def test_nought_and_what_is_beyond_mean_no_limit(time, ns):
    assert nanoseconds(time) == ns


@pytest.mark.parametrize('entry', ['reliability: perhaps', 'depth: -5', f'depth: {10**30}'])
def test_what_no_reader_of_ros_takes_is_not_handed_on(entry):
    assert OfferedQos.from_yaml(f'- {entry}') == ()
