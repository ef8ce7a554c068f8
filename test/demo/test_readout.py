"""Numbers beside the map: one width, no minus before zero, no line broken."""

from __future__ import annotations

import io
from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from agv_motion.demo.readout import bar, lines, number, pace, paragraphs, pose_text
from agv_motion.planar import Pose


@pytest.mark.parametrize(
    ('value', 'text'),
    [(-0.004, ' 0.00'), (-0.0, ' 0.00'), (-0.006, '-0.01'), (12.345, '12.35'), (0.0, ' 0.00')],
)
def test_by_hand(value, text):
    assert number(value, 5, 2) == text


@given(st.floats(-999.0, 999.0), st.booleans())
def test_one_width_and_no_minus_zero(value, sign):
    text = number(value, 8, 2, sign=sign)
    assert len(text) == 8
    assert '-0.00' not in text
    assert float(text) == pytest.approx(value, abs=0.00501)


@given(st.floats(0.0, 999.0))
def test_the_pace_is_never_zero_and_of_one_width(factor):
    text = pace(factor)
    assert len(text) == len(pace(60.0))
    assert ' 0.0 times' not in text


@given(st.floats(-99.0, 99.0), st.floats(-99.0, 99.0), st.floats(-50.0, 50.0))
def test_a_pose_has_one_width(x, y, theta):
    assert len(pose_text(Pose(x, y, theta))) == len(pose_text(Pose(0.0, 0.0, 0.0)))


def test_a_heading_lies_within_half_a_turn():
    assert pose_text(Pose(1.0, 2.0, 2.5 * pi)) == '  1.00   2.00 m   90°'


def shown(picture, width):
    """Return the lines of what is printed."""
    console = Console(width=width, height=24, file=io.StringIO())
    console.print(picture)
    return console.file.getvalue().splitlines()


def test_a_long_value_goes_on_below_and_ends_in_time():
    rows = [('state', 'resting: the sap flow of the tree has not come for a long time now, so')]
    told = shown(lines(rows, 29, tall=2), 80)
    assert told[0].rstrip() == 'state  resting: the sap flow'
    assert len(told) == 2
    assert told[1].rstrip().endswith('…')


@given(st.floats(-1.0, 2.0), st.text(alphabet='abc ', max_size=60))
def test_a_bar_is_one_line_of_one_width(share, doing):
    (line,) = shown(bar(share, doing, 80), 80)
    assert line.rstrip().endswith(' %')
    assert len(line.rstrip()) == len(shown(bar(0.5, 'driving', 80), 80)[0].rstrip())


def test_sentences_share_the_lines_there_are():
    long, short = 'a tree that waits for another one and says so at length', 'walking'
    told = [shown(each, 80) for each in paragraphs([short, long, short], 12, 8)]
    assert [len(each) for each in told] == [1, 5, 1]
    assert [line.strip() for line in told[1]][-2:] == ['and says so', 'at length']
    cut = [shown(each, 80) for each in paragraphs([long, short, long], 12, 6)]
    assert [len(each) for each in cut] == [2, 1, 3]
    assert cut[0][-1].rstrip().endswith('…')
    assert cut[1][0].strip() == short
