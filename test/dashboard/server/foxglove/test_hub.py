"""The live endpoint on a real socket: topics come and go, messages pass, the newest only."""

from __future__ import annotations

import json
import socket
import struct

import pytest


@pytest.mark.parametrize('subprotocol', ['foxglove.sdk.v1', 'foxglove.websocket.v1'])
def test_topics_come_messages_pass_and_topics_go(serve, connect, graph, subprotocol):
    graph.offer('/a', definition='string data\n')
    tool = connect(serve(), subprotocol)
    assert tool.socket.subprotocol == subprotocol
    assert tool.info['capabilities'] == ['parameters', 'parametersSubscribe', 'connectionGraph']
    (channel,) = tool.wait('advertise')['channels']
    assert channel == {
        'id': channel['id'], 'topic': '/a', 'encoding': 'cdr',
        'schemaName': 'std_msgs/msg/String', 'schema': 'string data\n',
        'schemaEncoding': 'ros2msg',
    }  # fmt: skip
    tool.ask('subscribe', subscriptions=[{'id': 5, 'channelId': channel['id']}])
    graph.wait_for({'/a'})
    graph.say(('/a', 123, b'\0\1\0\0one'), ('/a', 124, b'\0\1\0\0two'))
    first = tool.wait('message')
    assert (first['id'], first['stamp'], first['data']) == (5, 123, b'\0\1\0\0one')
    assert tool.data() == (5, b'\0\1\0\0two')
    graph.topics = {}
    assert tool.wait('unadvertise')['channelIds'] == [channel['id']]
    graph.wait_for(set())
    graph.offer('/a', definition='string data\n')
    assert tool.wait('advertise')['channels'][0]['id'] == channel['id']
    tool.ask('unsubscribe', subscriptionIds=[5])
    assert tool.refusal() == 'there is no subscription 5'


def test_a_server_speaks_both_names_and_prefers_the_better(serve, connect, graph):
    graph.offer('/a')
    server = serve()
    names = ['foxglove.websocket.v1', 'foxglove.sdk.v1']
    assert connect(server, subprotocols=names).socket.subprotocol == 'foxglove.sdk.v1'
    for unknown in (['foxglove.sdk.v9'], None):
        with pytest.raises(Exception, match='403'):
            connect(server, subprotocols=unknown)


def test_what_is_latched_comes_to_who_is_late(serve, connect, graph):
    graph.offer('/description', latched=True)
    server = serve()
    first = connect(server)
    first.subscribe('/description')
    graph.wait_for({'/description'})
    graph.say(('/description', 1, b'urdf'))
    assert first.data() == (0, b'urdf')
    late = connect(server)
    late.subscribe('/description')
    assert late.data() == (0, b'urdf')


def test_nothing_is_taken_that_nobody_wants(serve, connect, graph):
    graph.offer('/a')
    graph.offer('/b')
    tool = connect(serve())
    tool.subscribe('/a', '/b')
    graph.wait_for({'/a', '/b'})
    tool.ask('unsubscribe', subscriptionIds=[0])
    graph.wait_for({'/b'})
    tool.socket.close()
    graph.wait_for(set())


def test_a_simulated_time_is_told_and_where_it_begins_a_client_learns_of_it(serve, connect, graph):
    tool = connect(serve())
    assert 'time' not in tool.info['capabilities']
    graph.simulated, graph.clock = True, 5_000_000_001
    again = tool.wait('serverInfo')
    assert 'time' in again['capabilities']
    assert again['sessionId'] == tool.info['sessionId']
    assert struct.unpack('<Q', tool.wait('time')['bytes']) == (5_000_000_001,)


def test_topics_that_cannot_be_served_are_told(serve, connect, graph):
    graph.complaints = {'/x': 'its type p/msg/X is not installed'}
    told = connect(serve()).wait('status')
    assert told['id'] == '/x'
    assert told['message'] == '/x is not served: its type p/msg/X is not installed'


def test_who_never_reads_costs_others_nothing_and_has_no_queue(serve, connect, graph):
    """Megabytes are said; what waits for the one that is stalled stays within one look's."""
    graph.offer('/big')
    server = serve()
    host, port = server.listener.getsockname()
    stalled = socket.create_connection((host, port))
    stalled.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    stalled.sendall(
        f'GET /foxglove HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\nConnection: '
        'Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n'
        'Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n'.encode()
    )  # fmt: skip
    good = connect(server)
    good.subscribe('/big')
    (number,) = (c.info.id for c in server.room.hub.channels.by_number.values())
    said = json.dumps({'op': 'subscribe', 'subscriptions': [{'id': 1, 'channelId': number}]})
    mask = b'\1\2\3\4'
    masked = bytes(byte ^ mask[n % 4] for n, byte in enumerate(said.encode()))
    stalled.sendall(bytes([0x81, 0x80 | len(said)]) + mask + masked)
    graph.wait_for({'/big'})
    size = 200_000
    for count in range(60):
        graph.say(('/big', count, b'%04d' % count + bytes(size)))
        assert good.data()[1][:4] == b'%04d' % count
    hub = server.room.hub
    waiting = max(client.wire.waiting for client in hub.clients)
    assert 0 < waiting <= size + 100
    stalled.close()


def test_the_graph_is_told_to_who_asks_for_it(serve, connect, graph):
    tool = connect(serve())
    tool.ask('subscribeConnectionGraph')
    graph.connections = graph.connections._replace(published={'/a': ('/n',)})
    told = tool.wait('connectionGraphUpdate')
    assert told['publishedTopics'] == [{'name': '/a', 'publisherIds': ['/n']}]
    graph.connections = graph.connections._replace(published={})
    assert tool.wait('connectionGraphUpdate')['removedTopics'] == ['/a']
