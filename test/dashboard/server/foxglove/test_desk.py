"""What clients ask is done or refused: publishing, and one hand at a time."""

from __future__ import annotations

import struct

import pytest

TWIST = 'geometry_msgs/msg/TwistStamped'
HAND = '/oak/cmd_vel/manual'


def advertised(topic=HAND, kind=TWIST, number=1, encoding='cdr'):
    return {'id': number, 'topic': topic, 'encoding': encoding, 'schemaName': kind}


def publish(tool, data=b'\0\1\0\0' + bytes(47) + b'\1', number=1):
    tool.socket.send(struct.pack('<BI', 1, number) + data)


def test_what_a_person_says_is_published(tool, graph):
    tool.ask('advertise', channels=[advertised()])
    publish(tool)
    publish(tool, b'again')
    tool.ask('fetchAsset', uri='x', requestId=1)
    tool.wait('asset')
    assert [row[:2] for row in graph.published] == [(HAND, TWIST)] * 2
    assert graph.published[1][2] == b'again'


@pytest.mark.parametrize(
    ('channel', 'words'),
    [
        (advertised('/oak/cmd_vel'), 'cannot be published here'),
        (advertised('/oak/cmd_vel/agent'), 'cannot be published here'),
        (advertised(kind='std_msgs/msg/String'), f"'{HAND}' is of {TWIST} or"),
        (advertised(encoding='json'), "encoding 'json': only cdr"),
    ],
)
def test_what_nobody_may_publish_is_refused_and_its_messages_too(tool, graph, channel, words):
    tool.ask('advertise', channels=[channel])
    assert words in tool.refusal()
    publish(tool)
    assert 'there is no channel 1 of yours' in tool.refusal()
    assert graph.published == []


def test_one_hand_at_a_time_and_rest_always(acting, connect, graph):
    first, second = connect(acting), connect(acting)
    for one in (first, second):
        one.ask('advertise', channels=[advertised()])
    publish(first)
    first.ask('fetchAsset', uri='x', requestId=1)
    first.wait('asset')
    publish(second)
    assert second.refusal() == 'another person drives oak'
    publish(second, bytes(52))
    second.ask('fetchAsset', uri='x', requestId=1)
    second.wait('asset')
    assert [row[2] for row in graph.published] == [b'\0\1\0\0' + bytes(47) + b'\1', bytes(52)]


def test_channels_are_counted(tool, monkeypatch):
    monkeypatch.setattr('agv_motion.dashboard.server.foxglove.desk.MOST_CHANNELS', 1)
    tool.ask('advertise', channels=[advertised(), advertised(), advertised(number=2)])
    assert 'channel 1 is yours already' in tool.refusal()
    assert '1 channels are yours' in tool.refusal()
    tool.ask('unadvertise', channelIds=[1])
    tool.ask('advertise', channels=[advertised(number=2)])
    publish(tool)
    assert 'no channel 1 of yours' in tool.refusal()
