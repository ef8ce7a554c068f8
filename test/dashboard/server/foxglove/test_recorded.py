"""The endpoint over a bag, without ROS: played by Foxglove's controls, or by parameters."""

from __future__ import annotations

import asyncio
import struct
from types import SimpleNamespace as Some

import pytest

from agv_motion.bag import BagReader, BagWriter
from agv_motion.dashboard.server.access import Access
from agv_motion.dashboard.server.app import Foxglove, application
from agv_motion.dashboard.server.bag_fleet import BagFleet
from agv_motion.dashboard.server.foxglove.recorded import RecordedRoom
from agv_motion.dashboard.server.serve import WebServer, listening
from agv_motion.dashboard.server.site import Site

SECOND = 1_000_000_000
PAUSE, PLAY = 1, 0


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    """Return a bag of a counter, ten times a second for ten seconds, and a latched text."""
    from agv_motion.bag import OfferedQos

    path = tmp_path_factory.mktemp('bags') / 'counted'
    with BagWriter(path) as writer:
        offered = [OfferedQos(durability='transient_local')]
        latched = writer.add_topic('/description', 'std_msgs/msg/String', qos=offered)
        count = writer.add_topic('/count', 'std_msgs/msg/UInt32')
        writer.write(latched, SECOND, b'\0\1\0\0\x02\0\0\0u\0')
        for number in range(1, 101):
            stamp = SECOND + number * SECOND // 10
            writer.write(count, stamp, b'\0\1\0\0' + struct.pack('<I', number))
    return path


@pytest.fixture(scope='module')
def server(bag):
    room = RecordedRoom(bag, 20.0)
    site = Site(BagFleet(bag), Access('127.0.0.1', None), recorded=True)
    made = WebServer(
        application(site, foxglove=Foxglove(room, alone=True)), listening('127.0.0.1', 0)
    )
    made.start()
    yield Some(url=made.url)
    made.close()


def control(tool, command, speed=1.0, seek=None, number='n'):
    words = number.encode()
    seeks, stamp = seek is not None, seek or 0
    form = struct.pack('<BBfBQI', 3, command, speed, seeks, stamp, len(words))
    tool.socket.send(form + words)


def state(tool, number):
    """Return status, time, speed and whether it leapt, of the answer to a request."""
    told = tool.wait('playback', lambda t: t['bytes'][18:].decode() == number)['bytes']
    return struct.unpack_from('<BQfB', told)


def counts(tool, until):
    found = []
    while not found or found[-1] != until:
        number, data = tool.data()
        if number == 0:
            found.append(struct.unpack('<I', data[4:])[0])
    return found


@pytest.mark.parametrize('subprotocol', ['foxglove.sdk.v1', 'foxglove.websocket.v1'])
def test_all_that_is_in_the_bag_comes(server, connect, bag, subprotocol):
    tool = connect(server, subprotocol, path='/')
    newer = subprotocol == 'foxglove.sdk.v1'
    assert ('playbackControl' in tool.info['capabilities']) is newer
    assert tool.info.get('dataStartTime') == ({'sec': 1, 'nsec': 0} if newer else None)
    tool.ask('setParameters', parameters=[{'name': '/playback.seconds', 'value': 0}])
    tool.subscribe('/count', '/description')
    assert set(range(20, 101)) <= set(counts(tool, 100))
    assert any(told['op'] == 'time' for told in tool.kept)
    with BagReader(bag) as reader:
        texts = {reader.topics[t].definition for t in ('/count', '/description')}
    assert all(texts)


def test_controls_of_foxglove(server, connect):
    tool = connect(server)
    control(tool, PAUSE, 1.0, 6 * SECOND, 'first')
    assert state(tool, 'first') == (1, 6 * SECOND, 1.0, 1)
    tool.subscribe('/count', '/description')
    found = {tool.data() for _ in range(2)}
    assert found == {(0, b'\0\1\0\0' + struct.pack('<I', 49)), (1, b'\0\1\0\0\x02\0\0\0u\0')}
    control(tool, PLAY, 50.0, None, 'second')
    assert state(tool, 'second')[2] == 50.0
    assert counts(tool, 100) == list(range(50, 101))
    told = tool.wait('playback', lambda t: t['bytes'][0] == 3)
    assert struct.unpack_from('<BQ', told['bytes']) == (3, 11 * SECOND)
    control(tool, PLAY, 1e6, None, 'third')
    assert 'rate = 1000000.0: must lie in' in tool.refusal()


def test_playback_by_parameters_is_told_in_words(server, connect):
    tool = connect(server, 'foxglove.websocket.v1')
    rows = [{'name': '/playback.playing', 'value': False},
            {'name': '/playback.seconds', 'value': 2.5}]  # fmt: skip
    tool.ask('subscribeParameterUpdates', parameterNames=[])
    tool.ask('setParameters', parameters=rows, id='q')
    tool.wait('parameterValues', lambda t: t.get('id') == 'q')
    told = tool.wait('parameterValues', lambda t: 'id' not in t)
    values = {row['name']: row['value'] for row in told['parameters']}
    assert values == {'/playback.playing': False, '/playback.rate': 20.0, '/playback.seconds': 2.5}
    for name, value, words in (
        ('/playback.rate', 0, 'must lie in'), ('/playback.seconds', 99, 'must lie in [0, 10'),
        ('/playback.playing', 1, 'true or false'), ('/playback.x', 1, "no parameter '/playback.x'"),
    ):  # fmt: skip
        tool.ask('setParameters', parameters=[{'name': name, 'value': value}])
        assert words in tool.refusal()
    tool.ask('getParameters', parameterNames=['/x'])
    assert "no parameter '/x'" in tool.refusal()
    control(tool, PLAY)
    assert 'by the parameters' in tool.refusal()


def test_nothing_can_be_done_but_to_play(server, connect):
    tool = connect(server)
    tool.ask('advertise', channels=[])
    assert 'this is a recording' in tool.refusal()
    tool.ask('subscribe', subscriptions=[{'id': 1, 'channelId': 99}])
    assert 'no channel 99' in tool.refusal()
    tool.ask('unsubscribe', subscriptionIds=[4])
    assert 'no subscription 4' in tool.refusal()


def test_each_plays_by_itself(server, connect):
    first, second = connect(server), connect(server)
    control(first, PAUSE, 1.0, 3 * SECOND)
    control(second, PAUSE, 1.0, 5 * SECOND)
    assert state(first, 'n')[1] == 3 * SECOND
    assert state(second, 'n')[1] == 5 * SECOND


@pytest.mark.parametrize('speed', [-1.0, 1e-9, 1e30, -0.01])
def test_a_speed_that_is_none_is_refused_and_the_last_one_stays(server, connect, speed):
    tool = connect(server)
    control(tool, PAUSE, 4.0, 2 * SECOND, 'first')
    assert state(tool, 'first')[2] == 4.0
    control(tool, PLAY, speed)
    assert 'rate = ' in tool.refusal()
    control(tool, PAUSE, 0.0, None, 'second')  # no speed is told: it stays
    assert state(tool, 'second')[:3] == (1, 2 * SECOND, 4.0)


@pytest.mark.parametrize(('stamp', 'place'), [(0, SECOND), (2**64 - 1, 11 * SECOND)])
def test_beyond_the_bag_it_goes_to_its_end(server, connect, stamp, place):
    tool = connect(server)
    for number in ('once', 'twice'):
        control(tool, PAUSE, 1.0, stamp, number)
        assert state(tool, number)[1] == place


def test_numbers_that_are_none_are_refused(server, connect):
    tool = connect(server)
    for speed in (float('nan'), float('inf'), -float('inf')):
        control(tool, PLAY, speed)
        assert 'must be a finite number' in tool.refusal()


def test_who_takes_nothing_cannot_pile_up_requests(bag, monkeypatch, run_apart):
    """A client that only speaks: what it asks waits for the next look, which it puts off."""
    from agv_motion.dashboard.foxglove.requests import Control, ProtocolError
    from agv_motion.dashboard.server.foxglove import viewing

    monkeypatch.setattr(viewing, 'MOST_ASKED', 3)

    async def pile_up():
        made = viewed(bag)
        request = Control(False, 1.0, None, 'n')  # noqa: FBT003 - pause
        for _ in range(3):
            made.do(request)
        with pytest.raises(ProtocolError, match='3 requests wait'):
            made.do(request)
        made.end()

    run_apart(pile_up())


def viewed(bag):
    """Return a look at a bag of a client that is told nothing."""
    from agv_motion.dashboard.foxglove.permissions import Permissions
    from agv_motion.dashboard.server.foxglove.client import FoxgloveClient
    from agv_motion.dashboard.server.foxglove.viewing import Viewing

    client = FoxgloveClient(Some(waiting=1, write=lambda _: None), Permissions())
    return Viewing(RecordedRoom(bag), client, controls=True)


def test_of_many_leaps_between_two_looks_the_last_is_made(bag, monkeypatch, run_apart):
    """Each of them would read the bag; each is answered all the same."""
    from agv_motion.dashboard.foxglove.requests import Control

    async def leap():
        made, sought, answered = viewed(bag), [], []
        monkeypatch.setattr(made._player, 'seek', lambda stamp, now: sought.append(stamp))  # noqa: SLF001
        monkeypatch.setattr(made, '_tell_state', lambda number, leapt: answered.append(number))
        for number in range(50):
            made.do(Control(number % 2 == 0, 4.0, (2 + number) * SECOND, str(number)))
        made.do(Control(True, 0.0, None, 'last'))  # noqa: FBT003 - play, as fast as before
        asked, made._asked = made._asked, made._asked.__class__()  # noqa: SLF001
        made._looked(asked, 0.0)  # noqa: SLF001
        await asyncio.sleep(0)
        made.end()
        return sought, answered, made._player.rate  # noqa: SLF001

    sought, answered, rate = run_apart(leap())
    assert (sought, rate) == ([51 * SECOND], 4.0)
    assert answered == [*map(str, range(50)), 'last']


def test_what_is_set_one_after_the_other_is_all_set(server, connect):
    """Also where nobody has looked between two of them."""
    tool = connect(server)
    control(tool, PAUSE, 1.0, 2 * SECOND, 'first')
    for name, value in (('rate', 3.0), ('playing', False), ('seconds', 5.0)):
        told = {'name': f'/playback.{name}', 'value': value}
        tool.ask('setParameters', parameters=[told], id=name)
    told = tool.wait('parameterValues', lambda t: t.get('id') == 'seconds')
    values = {row['name']: row['value'] for row in told['parameters']}
    assert values == {'/playback.playing': False, '/playback.rate': 3.0, '/playback.seconds': 5.0}
