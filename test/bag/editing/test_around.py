"""Conditions on fields, and the times around messages that meet them."""

from __future__ import annotations

import struct
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.bag import BagReader, BagWriter
from agv_motion.bag.columns.condition import condition
from agv_motion.bag.editing.around import happenings, windows
from agv_motion.errors import ConfigurationError

SECOND = 10**9
JOINTS = 'float64[] position\nfloat64[2] limits\nbool stuck\n'


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    folder = tmp_path_factory.mktemp('bags') / 'bag'
    with BagWriter(folder) as writer:
        residual = writer.add_topic('/residual', 'a/msg/F', 'float64 data', type_hash='')
        joints = writer.add_topic('/joints', 'a/msg/J', JOINTS, type_hash='')
        state = writer.add_topic('/state', 'a/msg/S', 'string data', type_hash='')
        for i in range(20):
            value = np.nan if i == 9 else (0.05 if i in (3, 4, 12) else 0.01)
            writer.write(residual, i * SECOND, struct.pack('<4sd', b'\0\1\0\0', value))
            count = i % 3
            data = struct.pack('<4sII', b'\0\1\0\0', count, 0)
            data += struct.pack(f'<{count}d', *(i + k for k in range(count)))
            data += struct.pack('<2d?', -1.0, float(i), i == 7)
            writer.write(joints, i * SECOND, data)
            word = b'stopped' if i > 15 else b'walking'
            text = struct.pack('<4sI', b'\0\1\0\0', len(word) + 1) + word + b'\0'
            writer.write(state, i * SECOND, text)
    with BagReader(folder) as reader:
        yield reader


def seconds(bag, text):
    found = happenings(bag, condition(text))
    return found.events, (found.stamps // SECOND).tolist()


@pytest.mark.parametrize(('text', 'events', 'times'), [
    ('/residual > 0.02', 2, [3, 4, 12]), ('/residual>=0.05', 2, [3, 4, 12]),
    ('/residual/data > 0.02', 2, [3, 4, 12]), ('/residual == 0.05', 2, [3, 4, 12]),
    ('/residual < 0', 0, []), ('/state ~ stop', 1, [16, 17, 18, 19]),
    ('/state == stopped', 1, [16, 17, 18, 19]), ("/state != 'walking'", 1, [16, 17, 18, 19]),
    ('/joints/position > 19.5', 0, []), ('/joints/position > 16.5', 2, [17, 19]),
    ('/joints/position[1] > 13.5', 2, [14, 17]), ('/joints/position[0] == 16', 1, [16]),
    ('/joints/limits[1] >= 18', 1, [18, 19]), ('/joints/limits < 0', 1, list(range(20))),
    ('/joints/stuck == true', 1, [7]), ('/joints/stuck == 1', 1, [7]),
])  # fmt: skip
def test_conditions(bag, text, events, times):
    assert seconds(bag, text) == (events, times)


@pytest.mark.parametrize(('text', 'words'), [
    ('/residual', 'is no condition'), ('> 5', 'is no condition'), ('/residual > ', 'is no cond'),
    ('/gone > 5', 'is in no topic'), ('/residual > much', 'takes a finite number'),
    ('/residual > nan', 'takes a finite number'), ('/residual <= -inf', 'takes a finite number'),
    ('/residual == much', 'has no texts'), ('/state > a', 'texts are compared by'),
    ('/joints > 5', r'has 3 numbers \(position, limits, stuck\)'),
    ('/joints/limits[2] > 5', 'array of 2'), ('/residual[0] > 5', 'no array'),
    ('/joints/speed > 5', 'speed'), ('/residual ~ 5', 'no texts'),
])  # fmt: skip
def test_what_cannot_be_asked_is_told(bag, text, words):
    with pytest.raises(ConfigurationError, match=words):
        happenings(bag, condition(text))


def test_windows_that_overlap_or_touch_are_joined():
    assert windows([100, 105, 130], 3, 4) == ((97, 110), (127, 135))
    assert windows([5], 100, 0) == ((0, 6),)
    assert windows([], 1, 1) == ()
    assert windows(np.array([2**63 + 5], np.uint64), 1, 1) == ((2**63 + 4, 2**63 + 7),)


@given(st.lists(st.integers(0, 200)).map(sorted), st.integers(0, 20), st.integers(0, 20))
def test_windows_hold_exactly_what_is_near(stamps, before, after):
    found = windows(stamps, before, after)
    near = {t for s in stamps for t in range(max(s - before, 0), s + after + 1)}
    assert {t for a, b in found for t in range(a, b)} == near
    assert all(a[1] < b[0] for a, b in pairwise(found))
