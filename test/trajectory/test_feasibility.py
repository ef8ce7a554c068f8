"""The report of a plan: ten lines at most, the slowest stretches among them."""

from __future__ import annotations

from agv_motion.trajectory.feasibility import MOST_LINES, Feasibility, Slow


def report(stretches):
    slow = tuple(
        Slow(float(k), k + 0.5, 1.0 + (k * 7 % stretches) / stretches, 'turn rate')
        for k in range(stretches)
    )
    return Feasibility(9.0, 1.0, 20.0, 0.5, 2.0, slow).lines()


def test_seven_stretches_are_all_told():
    lines = report(7)
    assert len(lines) == MOST_LINES
    assert 'turn rate' in lines[-1]


def test_of_four_hundred_the_slowest_are_told_in_the_order_of_the_way_and_the_rest_counted():
    lines = report(400)
    assert len(lines) == MOST_LINES
    assert lines[-1] == 'and 394 more stretches, less slow'
    told = [float(line.split()[1]) for line in lines[3:-1]]
    assert told == sorted(told)
    assert 0.0 in told  # the slowest of all
