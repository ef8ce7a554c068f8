"""What an index tells of a bag."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / 'editing'))

import bags

from agv_motion.bag.catalog.discovery import size
from agv_motion.bag.catalog.entry import entry_of

SECOND = 10**9
MAY = 1_714_521_600


def test_an_entry_is_what_the_bag_tells(season):
    entry = entry_of(season / 'b')
    assert (entry.start, entry.end) == ((MAY + 200) * SECOND, (MAY + 204) * SECOND - SECOND // 10)
    assert (entry.messages, entry.fault, entry.size) == (41, '', size(season / 'b'))
    assert [(t.name, t.type, t.messages) for t in entry.topics] == [
        ('/a', bags.TEXT, 20), ('/x', bags.TEXT, 20), ('/map', bags.TEXT, 1),
    ]  # fmt: skip
    assert sum(t.size for t in entry.topics) == pytest.approx(41 * 46, rel=0.1)
    assert 'agv bag recover' in entry_of(season / 'loose.mcap').fault
    assert 'does not exist' in entry_of(season / 'gone').fault
