"""What is lost is told exactly for one publisher, and never invented for several."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from agv_motion.bag.recording.sequence_gaps import MOST_PUBLISHERS, SequenceGaps

SECOND = 1_000_000_000


def follow(numbers, publishers=1):
    gaps = SequenceGaps()
    gaps.publishers = publishers
    for i, number in enumerate(numbers):
        gaps.see(number, i * SECOND)
    return gaps


@given(st.lists(st.booleans(), min_size=1), st.integers(1, 2**40))
def test_of_one_publisher_every_gap_after_the_first_message_counts(arrived, first):
    numbers = [first + i for i, there in enumerate(arrived) if there]
    lost = numbers[-1] - numbers[0] + 1 - len(numbers) if numbers else 0
    assert follow(numbers).lost == lost


@given(st.lists(st.integers(0, 2), max_size=50), st.tuples(*[st.integers(1, 10**6)] * 3))
def test_several_publishers_that_lose_nothing_lose_nothing(turns, first):
    following = list(first)
    numbers = []
    for publisher in turns:
        numbers.append(following[publisher])
        following[publisher] += 1
    if len(set(first)) == 3 and all(turn in turns for turn in range(3)):
        assert follow(numbers, publishers=3).lost == 0


def test_a_publisher_that_starts_again_loses_nothing():
    assert follow([7, 8, 1, 2, 3]).lost == 0


def test_what_went_by_in_a_pause_is_not_lost():
    gaps = follow([1, 2])
    gaps.interrupt()
    gaps.see(9, 2 * SECOND)
    assert gaps.lost == 0


def test_rate_and_silence_by_the_times_of_sending():
    gaps = SequenceGaps()
    for time in (0.0, 0.5, 1.0, 3.0):
        gaps.see(0, int(time * SECOND))
    assert (gaps.messages, gaps.lost) == (4, 0)
    assert gaps.rate == 1.0
    assert gaps.longest_silence == 2 * SECOND


def test_a_number_that_comes_late_or_follows_far_behind():
    """Of two publishers, 20 follows 8, not 3; 8 in its turn is new, since two are known."""
    gaps = follow([2, 7, 20], publishers=2)
    assert (gaps.lost, gaps._expected) == (12, [3, 21])  # noqa: SLF001 - the state itself
    gaps.see(5, 9 * SECOND)
    assert (gaps.lost, gaps._expected) == (14, [21, 6])  # noqa: SLF001 - as above
    gaps.see(1, 9 * SECOND)  # below all: somebody began anew
    assert (gaps.lost, gaps._expected) == (14, [21, 6, 2])  # noqa: SLF001 - as above


def test_numbers_are_followed_of_so_many_publishers_and_no_more():
    gaps = follow(range(200, 200 - 2 * MOST_PUBLISHERS, -2), publishers=99)
    assert len(gaps._expected) == MOST_PUBLISHERS  # noqa: SLF001 - as above
    gaps.see(1, 0)
    assert len(gaps._expected) == MOST_PUBLISHERS  # noqa: SLF001 - as above
    gaps.see(201, 0)
    assert (gaps.lost, gaps._expected[-1]) == (0, 202)  # noqa: SLF001 - as above
    assert follow([0, 0]).lost == 0


def test_times_that_go_back_are_no_silence_and_none_are_no_rate():
    gaps = follow([])
    assert (gaps.rate, gaps.longest_silence) == (0.0, 0)
    for time, silence, rate in ((7, 0, 0.0), (9, 2, 0.5), (8, 2, 1.0), (12, 3, 0.6)):
        gaps.see(0, time * SECOND)
        assert (gaps.longest_silence, gaps.rate) == (silence * SECOND, rate)
