"""What the server says, byte by byte as the specification has it."""

from __future__ import annotations

import json
import math

from agv_motion.dashboard.foxglove import protocol
from agv_motion.dashboard.foxglove.protocol import (
    Capability,
    ChannelInfo,
    ConnectionGraph,
    PlaybackStatus,
    ServiceInfo,
    Severity,
)


def test_binary_messages_are_little_endian():
    assert protocol.time_data(258) == bytes.fromhex('02 0201000000000000')
    assert protocol.service_response(2, 3, 'cdr', b'z') == bytes.fromhex(
        '03 02000000 03000000 03000000 636472 7a'
    )
    assert protocol.asset_refusal(5, 'no') == bytes.fromhex('04 05000000 01 02000000 6e6f')


def test_state_of_a_playback_is_as_foxglove_sdk_has_it():
    """The bytes are those of its own snapshot tests."""
    told = protocol.playback_state(
        PlaybackStatus.PLAYING, 12345, 1.0, leapt=False, number='i-am-a-request'
    )
    assert told == (
        b'\x05\x00' + (12345).to_bytes(8, 'little') + b'\x00\x00\x80\x3f\x00'
        + (14).to_bytes(4, 'little') + b'i-am-a-request'
    )  # fmt: skip
    assert protocol.playback_state(PlaybackStatus.ENDED, 0, 0.5, leapt=True)[
        -5:
    ] == b'\x01' + bytes(4)


def test_a_server_tells_encodings_only_where_one_may_act():
    told = json.loads(protocol.server_info('us', [Capability.TIME], '1'))
    assert told == {
        'op': 'serverInfo', 'name': 'us', 'capabilities': ['time'], 'metadata': {},
        'sessionId': '1',
    }  # fmt: skip
    told = json.loads(protocol.server_info('us', [Capability.PUBLISH], '1', (1_500_000_000, 2)))
    assert told['supportedEncodings'] == ['cdr']
    assert told['dataStartTime'] == {'sec': 1, 'nsec': 500_000_000}
    assert told['dataEndTime'] == {'sec': 0, 'nsec': 2}


def test_channels_and_services_bear_their_definitions():
    told = json.loads(protocol.advertise([ChannelInfo(3, '/a', 'p/msg/T', 'int8 x')]))
    assert told['channels'] == [{
        'id': 3, 'topic': '/a', 'encoding': 'cdr', 'schemaName': 'p/msg/T', 'schema': 'int8 x',
        'schemaEncoding': 'ros2msg',
    }]  # fmt: skip
    told = json.loads(
        protocol.advertise_services([ServiceInfo(1, '/s', 'std_srvs/srv/SetBool', 'bool d', 'b')])
    )
    (service,) = told['services']
    assert service['request'] == {
        'encoding': 'cdr', 'schemaName': 'std_srvs/srv/SetBool_Request',
        'schemaEncoding': 'ros2msg', 'schema': 'bool d',
    }  # fmt: skip
    assert service['responseSchema'] == service['response']['schema'] == 'b'


def test_no_parameter_is_told_as_a_number_that_json_does_not_have():
    told = json.loads(
        protocol.parameter_values(
            {'/n.a': math.nan, '/n.b': 2.0, '/n.c': [1.5, 2.0], '/n.d': [math.inf], '/n.e': 'x',
             '/n.f': None, '/n.g': True, '/n.h': 3}, 'seven'
        )
    )  # fmt: skip
    rows = {row.pop('name'): row for row in told['parameters']}
    assert rows == {
        '/n.a': {}, '/n.b': {'value': 2.0, 'type': 'float64'},
        '/n.c': {'value': [1.5, 2.0], 'type': 'float64_array'}, '/n.d': {},
        '/n.e': {'value': 'x'}, '/n.f': {}, '/n.g': {'value': True}, '/n.h': {'value': 3},
    }  # fmt: skip
    assert told['id'] == 'seven'


def test_a_graph_is_told_by_what_has_changed():
    before = ConnectionGraph({'/a': ('/x',), '/b': ('/x',)}, {'/a': ('/y',)}, {'/s': ('/x',)})
    now = ConnectionGraph({'/a': ('/x', '/z'), '/c': ('/x',)}, {'/b': ('/y',)}, {})
    told = json.loads(protocol.graph_update(now, before))
    assert told == {
        'op': 'connectionGraphUpdate',
        'publishedTopics': [
            {'name': '/a', 'publisherIds': ['/x', '/z']}, {'name': '/b', 'publisherIds': []},
            {'name': '/c', 'publisherIds': ['/x']},
        ],
        'subscribedTopics': [
            {'name': '/a', 'subscriberIds': []}, {'name': '/b', 'subscriberIds': ['/y']},
        ],
        'advertisedServices': [{'name': '/s', 'providerIds': []}],
        'removedTopics': [], 'removedServices': ['/s'],
    }  # fmt: skip
    assert protocol.graph_update(now, now) == ''


def test_words_have_an_end():
    assert len(json.loads(protocol.status(Severity.ERROR, 'x' * 10**6, 'n'))['message']) == 1000
    assert len(json.loads(protocol.service_failure(1, 2, 'x' * 10**6))['message']) == 1000
