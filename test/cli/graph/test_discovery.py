"""What is known of a graph is whole when it goes together, and nobody waits for longer."""

from __future__ import annotations

from unittest.mock import MagicMock

import pytest

from agv_motion.cli.graph import discovery
from agv_motion.cli.graph.discovery import STRANGE, is_gapless, whole
from agv_motion.cli.graph.participants import GRAPH_TOPIC

OWN, OTHER = b'a' * 12, b'b' * 12


def participant(prefix, name, *, server='', client='', topic=''):
    """Return all ends of a participant of ROS with one node, numbered as Fast DDS does."""
    ends = [(GRAPH_TOPIC, True, ''), (GRAPH_TOPIC, False, '')]
    if server:
        ends += [(f'rq/{server}Request', False, name), (f'rr/{server}Reply', True, name)]
    if client:
        ends += [(f'rq/{client}Request', True, name), (f'rr/{client}Reply', False, name)]
    if topic:
        ends.append((f'rt/{topic}', True, name))
    return frozenset(
        (topic, prefix + number.to_bytes(3, 'big') + b'\x03', writes, node)
        for number, (topic, writes, node) in enumerate(ends, 1)
    )


ALL = participant(OWN, 'own', topic='rosout') | participant(
    OTHER, 'other', server='go', client='stop', topic='cmd_vel'
)


def test_all_of_it_is_whole():
    assert whole(ALL)
    assert whole(frozenset())


@pytest.mark.parametrize('end', sorted(ALL))
def test_without_any_end_that_has_another_half_it_is_not(end):
    """A topic of its own has no other half: what it lacks comes within the time to settle."""
    assert whole(ALL - {end}) is end[0].startswith('rt/')


@pytest.mark.parametrize('name', STRANGE)
def test_an_end_of_no_node_is_waited_for(name):
    (end,) = (one for one in ALL if one[0] == 'rt/cmd_vel')
    assert not whole(ALL - {end} | {(*end[:3], name)})


def test_what_is_no_ros_is_not_waited_for():
    bare = ('rt/camera', b'c' * 12 + b'0001', True, STRANGE[1])
    assert whole(ALL | {bare})


def test_one_server_more_in_another_process_is_no_half():
    assert whole(ALL | participant(b'd' * 12, 'twin', server='go'))


@pytest.fixture
def settled_after(monkeypatch):
    """Return what tells after how many seconds, on a clock of its own, a graph is known."""
    now = 0.0

    def spin_once(_, timeout_sec):
        nonlocal now
        now += timeout_sec

    def run(
        ends, missing=lambda _: 0, *, nobody=False, counted=False, spin_time=discovery.DISCOVERY
    ):
        nonlocal now
        now = 0.0
        monkeypatch.setattr(discovery, 'ends_of', lambda _: ends(now))
        monkeypatch.setattr(discovery, 'missing', lambda *_: missing(now))
        monkeypatch.setattr(discovery, 'are_all_on_this_machine', lambda _: counted)
        monkeypatch.setattr(discovery, 'is_alone', lambda _: nobody)
        monkeypatch.setattr(discovery, 'call', lambda _: calls.append(now))
        calls.clear()
        discovery.settle(MagicMock(), spin_time)
        return now

    calls = run.calls = []

    rclpy = pytest.importorskip('rclpy')
    monkeypatch.setattr(rclpy, 'spin_once', spin_once)
    monkeypatch.setattr(discovery.time, 'monotonic', lambda: now)
    return run


HALF = frozenset(list(participant(OTHER, 'other', server='go'))[:1])


@pytest.mark.parametrize(
    ('ends', 'missing', 'nobody', 'seconds'),
    [
        (lambda _: ALL, lambda _: 0, False, 0.5),  # all there at once: as ros2 --no-daemon
        (lambda now: ALL if now > 1.0 else HALF, lambda _: 0, False, 1.2),  # whole, and 0.2 s calm
        (lambda _: ALL, lambda now: now < 2.0, False, 2.0),  # one was heard late
        (lambda _: ALL, lambda _: 1, False, 10.0),  # one is frozen
        (lambda _: HALF, lambda _: 0, False, 4.0),  # one that never goes together
        (lambda _: frozenset(), lambda _: 0, True, 1.5),  # nobody, maybe on another machine
    ],
)
def test_how_long_is_listened(settled_after, ends, missing, nobody, seconds):
    assert settled_after(ends, missing, nobody=nobody) == pytest.approx(seconds, abs=0.21)


def test_who_asks_for_longer_has_longer(settled_after):
    for counted in (False, True):
        found = settled_after(lambda _: ALL, counted=counted, spin_time=3.0)
        assert found == pytest.approx(3.0, abs=0.06)


GAPPED = ALL - {next(end for end in ALL if end[0] == 'rt/cmd_vel')} | {
    ('rt/cmd_vel', OTHER + b'\x00\x00\x09\x03', True, 'other')
}


@pytest.mark.parametrize(
    ('ends', 'missing', 'seconds'),
    [
        (lambda _: ALL, lambda _: 0, discovery.BRIEF),
        (lambda _: GAPPED, lambda _: 0, discovery.SETTLED),  # an end was closed, or is to come
        (lambda now: ALL if now > 0.15 else GAPPED, lambda _: 0, 0.15 + discovery.BRIEF),
        (lambda _: ALL, lambda now: now < 0.4, 0.4),  # one was heard late
        (lambda now: ALL if now > 0.4 else HALF, lambda _: 0, 0.4 + discovery.BRIEF),
    ],
)
def test_where_all_are_counted_is_listened_until_all_were_heard(
    settled_after, ends, missing, seconds
):
    found = settled_after(ends, missing, counted=True)
    assert seconds <= found <= seconds + 2.0 * discovery.EXAMINE + discovery.LOOK


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


def test_a_number_that_is_left_out_is_a_gap():
    assert is_gapless(ALL)
    assert is_gapless(frozenset())
    assert not is_gapless(GAPPED)
    assert not is_gapless(frozenset(end for end in ALL if end[1][-2] != 1))
