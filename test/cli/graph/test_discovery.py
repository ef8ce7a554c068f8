"""A graph is known when all has been heard that its participants name, and nobody waits longer."""

from __future__ import annotations

from unittest.mock import MagicMock

import pytest

from agv_motion.cli.graph import discovery
from agv_motion.cli.graph.discovery import strangers, unfinished
from agv_motion.cli.graph.participants import GRAPH_TOPIC

OWN, OTHER = b'a' * 12, b'b' * 12


def participant(prefix, name, *topics):
    """Return all ends of a participant of ROS with one node."""
    ends = [(GRAPH_TOPIC, True, ''), (GRAPH_TOPIC, False, '')]
    ends += [(f'rt/{topic}', topic == 'rosout', name) for topic in ('rosout', *topics)]
    return frozenset(
        (topic, prefix + number.to_bytes(3, 'big') + b'\x03', writes, node)
        for number, (topic, writes, node) in enumerate(ends, 1)
    )


ALL = participant(OWN, 'own') | participant(OTHER, 'other', 'cmd_vel', 'odom')
TOLD = {
    prefix: frozenset((end[1], end[3]) for end in ALL if end[1][:12] == prefix and end[3])
    for prefix in (OWN, OTHER)
}
LAST = max(end for end in ALL if end[3] == 'other')
"""The subscription that comes last, so that its lack leaves no gap"""


def test_nothing_more_is_waited_for_than_what_was_named():
    assert unfinished(ALL, TOLD) == set()
    assert unfinished(frozenset(), TOLD) == set()  # they were here, and have gone


@pytest.mark.parametrize('end', sorted(end for end in ALL if end[3]))
def test_any_end_that_was_named_is_waited_for(end):
    assert unfinished(ALL - {end}, TOLD) == {end[1][:12]}


@pytest.mark.parametrize('name', ['_NODE_NAME_UNKNOWN_', 'own'])
def test_an_end_is_waited_for_until_it_is_known_whose_it_is(name):
    assert unfinished(ALL - {LAST} | {(*LAST[:3], name)}, TOLD) == {OTHER}


def test_who_has_not_named_its_ends_is_waited_for():
    assert unfinished(ALL, {OWN: TOLD[OWN]}) == {OTHER}
    for only in (True, False):  # of its two ends on the graph's topic either comes first
        ends = frozenset(end for end in ALL if end[0] == GRAPH_TOPIC and end[2] is only)
        assert unfinished(ends, {}) == {OWN, OTHER}


def test_what_is_no_ros_names_nothing():
    bare = ('rt/camera', b'c' * 12 + b'0001', True, '_CREATED_BY_BARE_DDS_APP_')
    assert unfinished(ALL | {bare}, TOLD) == set()
    assert strangers(ALL | {bare}) == {b'c' * 12}
    assert strangers(ALL) == set()


def test_where_nobody_can_be_asked_nobody_is_waited_for():
    assert unfinished(ALL, None) == set()


@pytest.fixture
def settled_after(monkeypatch):
    """Return what tells after how many seconds, on a clock of its own, a graph is known."""
    now = 0.0

    def spin_once(_, timeout_sec):
        nonlocal now
        now += timeout_sec

    def run(
        ends,
        missing=lambda _: 0,
        *,
        told=lambda _: TOLD,
        counted=False,
        spin_time=discovery.DISCOVERY,
    ):
        nonlocal now
        now = 0.0
        topic = MagicMock()
        topic.return_value.__enter__.return_value.told = lambda: told(now)
        monkeypatch.setattr(discovery, 'ParticipantEntities', topic)
        monkeypatch.setattr(discovery, 'ends_of', lambda _: ends(now))
        monkeypatch.setattr(discovery, 'missing', lambda *_: missing(now))
        monkeypatch.setattr(discovery, 'are_all_on_this_machine', lambda _: counted)
        monkeypatch.setattr(discovery, 'is_alone', lambda _: not ends(now))
        monkeypatch.setattr(discovery, 'call', lambda _: calls.append(now))
        calls.clear()
        discovery.settle(MagicMock(), spin_time)
        return now

    calls = run.calls = []

    rclpy = pytest.importorskip('rclpy')
    monkeypatch.setattr(rclpy, 'spin_once', spin_once)
    monkeypatch.setattr(discovery.time, 'monotonic', lambda: now)
    return run


HALF = ALL - {LAST}
BARE = ALL | {('rt/camera', b'c' * 12 + b'0001', True, '_CREATED_BY_BARE_DDS_APP_')}


@pytest.mark.parametrize(
    ('ends', 'missing', 'seconds'),
    [
        (lambda _: ALL, lambda _: 0, 0.5),  # all there at once: as ros2 --no-daemon
        (lambda now: ALL if now > 1.0 else HALF, lambda _: 0, 1.0),  # the last came late
        (lambda now: BARE if now > 1.0 else ALL, lambda now: now < 1.0, 1.2),  # and calm
        (lambda _: ALL, lambda now: now < 2.0, 2.0),  # one was heard late
        (lambda _: ALL, lambda _: 1, 10.0),  # one is frozen
        (lambda _: HALF, lambda _: 0, 10.0),  # one froze in the midst
        (lambda _: frozenset(), lambda _: 0, 1.5),  # nobody, maybe on another machine
    ],
)
def test_how_long_is_listened(settled_after, ends, missing, seconds):
    assert settled_after(ends, missing) == pytest.approx(seconds, abs=0.11)


def test_who_asks_for_longer_has_longer(settled_after):
    for counted in (False, True):
        found = settled_after(lambda _: ALL, counted=counted, spin_time=3.0)
        assert found == pytest.approx(3.0, abs=0.11)


@pytest.mark.parametrize(
    ('ends', 'told', 'missing', 'seconds'),
    [
        (lambda _: ALL, lambda _: TOLD, lambda _: 0, 0.0),
        (lambda _: ALL, lambda _: TOLD, lambda now: now < 0.4, 0.4),  # one was heard late
        (lambda now: ALL if now > 0.6 else HALF, lambda _: TOLD, lambda _: 0, 0.6),
        (lambda _: ALL, lambda now: TOLD if now > 0.6 else {}, lambda _: 0, 0.6),
        (lambda _: BARE, lambda _: TOLD, lambda _: 0, discovery.SETTLED),
        (lambda _: ALL, lambda _: None, lambda _: 0, discovery.SETTLED),
    ],
)
def test_where_all_are_counted_is_listened_until_all_were_heard_out(
    settled_after, ends, told, missing, seconds
):
    found = settled_after(ends, missing, told=told, counted=True)
    assert seconds <= found <= seconds + 2.0 * discovery.EXAMINE + discovery.FIRST


def test_who_was_not_heard_is_called_until_all_are_there(settled_after):
    settled_after(lambda _: ALL, lambda _: 0, counted=True)
    assert settled_after.calls == []
    settled_after(lambda _: ALL, lambda now: now < 0.5, counted=True)
    assert settled_after.calls == pytest.approx([0.1, 0.3], abs=0.06)
    settled_after(lambda _: ALL, lambda _: 1, counted=True)
    assert len(settled_after.calls) == len(discovery.CALLS)
    settled_after(
        lambda _: ALL, lambda _: 0
    )  # others may be where this machine's ports tell nothing
    assert settled_after.calls == pytest.approx([0.1, 0.3], abs=0.06)
