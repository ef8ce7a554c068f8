"""What a client says is understood, or refused in words: nothing else ever comes of it."""

from __future__ import annotations

import json
import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.dashboard.foxglove import requests as asked
from agv_motion.dashboard.foxglove.parsing import MOST, parsed
from agv_motion.dashboard.foxglove.requests import ProtocolError


def text(op, **told):
    return json.dumps({'op': op} | told)


def test_what_clients_say_is_understood():
    rows = [{'id': 4, 'channelId': 9}, {'id': 0, 'channelId': 1}]
    assert parsed(text('subscribe', subscriptions=rows)) == asked.Subscribe({4: 9, 0: 1})
    assert parsed(text('unsubscribe', subscriptionIds=[4])) == asked.Unsubscribe([4])
    row = {'id': 1, 'topic': '/t', 'encoding': 'cdr', 'schemaName': 'p/msg/T', 'schema': 'x'}
    assert parsed(text('advertise', channels=[row])).channels == [
        asked.ClientChannel(1, '/t', 'cdr', 'p/msg/T')
    ]
    assert parsed(text('unadvertise', channelIds=[1])) == asked.Unadvertise([1])
    assert parsed(text('getParameters', parameterNames=[])) == asked.GetParameters([], '')
    assert parsed(text('subscribeParameterUpdates', parameterNames=['/n.a'])) == (
        asked.WatchParameters(['/n.a'], on=True)
    )
    assert parsed(text('unsubscribeParameterUpdates', parameterNames=[])).on is False
    assert parsed(text('subscribeConnectionGraph')) == asked.WatchGraph(on=True)
    assert parsed(text('unsubscribeConnectionGraph')) == asked.WatchGraph(on=False)
    assert parsed(text('fetchAsset', uri='package://x', requestId=3)).id == 3


def test_values_have_the_type_that_is_told_with_them():
    rows = [
        {'name': '/n.a', 'value': 3}, {'name': '/n.b', 'value': 3, 'type': 'float64'},
        {'name': '/n.c', 'value': [1, 2.5], 'type': 'float64_array'},
        {'name': '/n.d', 'value': 'x'}, {'name': '/n.e', 'value': [True]},
    ]  # fmt: skip
    found = parsed(text('setParameters', parameters=rows, id='q'))
    assert found.id == 'q'
    assert repr(found.values) == repr(
        {'/n.a': 3, '/n.b': 3.0, '/n.c': [1.0, 2.5], '/n.d': 'x', '/n.e': [True]}
    )


def test_bytes_are_understood():
    assert parsed(struct.pack('<BI', 1, 7) + b'abc') == asked.Publish(7, b'abc')
    assert parsed(struct.pack('<BIII', 2, 5, 6, 3) + b'cdrxy') == asked.Call(5, 6, 'cdr', b'xy')
    told = struct.pack('<BBfBQI', 3, 0, 1.5, 1, 100_500_000_000, 7) + b'some-id'
    assert parsed(told) == asked.Control(
        playing=True, speed=1.5, seek=100_500_000_000, id='some-id'
    )
    told = struct.pack('<BBfBQI', 3, 1, 2.0, 0, 99, 0)
    assert parsed(told) == asked.Control(playing=False, speed=2.0, seek=None, id='')


@pytest.mark.parametrize(
    ('said', 'words'),
    [
        ('', 'no JSON'), ('{"op": NaN}', 'NaN is no number'), ('[' * 100_000, 'no JSON'),
        ('[]', 'got list'), ('{}', 'op None is not known; there are subscribe,'),
        (text('explode'), "op 'explode' is not known"), (text(['subscribe']), 'is not known'),
        (text('subscribe'), 'subscriptions = None: expected a list'),
        (text('subscribe', subscriptions=[1]), 'expected objects'),
        (text('subscribe', subscriptions=[{'id': -1, 'channelId': 1}]), 'id = -1'),
        (text('subscribe', subscriptions=[{'id': True, 'channelId': 1}]), 'id = True'),
        (text('subscribe', subscriptions=[{'id': 2**32, 'channelId': 1}]), f'id = {2**32}'),
        (text('subscribe', subscriptions=[{'id': 1, 'channelId': 1.5}]), 'channelId = 1.5'),
        (text('subscribe', subscriptions=[{'id': 1, 'channelId': 1}] * 2), 'comes twice'),
        (text('unsubscribe', subscriptionIds=[0] * (MOST + 1)), f'at most {MOST}'),
        (text('advertise', channels=[{'id': 1, 'topic': ''}]), 'topic ='),
        (text('getParameters', parameterNames=['x' * 600]), 'expected a text'),
        (text('getParameters', parameterNames=[], id=5), 'id = 5'),
        ('{"op":"setParameters","parameters":[{"name":"/n.a","value":NaN}]}', 'NaN'),
        ('{"op":"setParameters","parameters":[{"name":"/n.a","value":1e999}]}', 'beyond every'),
        ('{"op":"setParameters","parameters":[{"name":"/n.a","value":-Infinity}]}', 'Infinity'),
        (text('setParameters', parameters=[{'name': '/n.a'}]), 'cannot be removed'),
        (text('setParameters', parameters=[{'name': '/n.a', 'value': {'x': 1}}]), 'expected a num'),
        (text('setParameters', parameters=[{'name': 'a', 'value': 'x', 'type': 'float64'}]),
         'is no float64'),
        (text('setParameters', parameters=[{'name': 'a', 'value': 1, 'type': 'byte_array'}]),
         'is not taken'),
        (text('setParameters', parameters=[{'name': 'a', 'value': 10**400, 'type': 'float64'}]),
         'beyond every'),
        (b'', 'empty message'), (b'\x09', 'opcode 9'), (b'\x01\x00', 'at least 5'),
        (struct.pack('<BIII', 2, 5, 6, 9999) + b'cdr', '9999 bytes'),
        (struct.pack('<BIII', 2, 5, 6, 2) + b'\xff\xfe', 'not UTF-8'),
        (struct.pack('<BBfBQI', 3, 2, 1.0, 0, 0, 0), 'command 2'),
        (struct.pack('<BBfBQI', 3, 0, float('nan'), 0, 0, 0), 'speed nan'),
    ],
)  # fmt: skip
def test_what_is_not_of_the_protocol_is_refused_in_words(said, words):
    with pytest.raises(ProtocolError) as refused:
        parsed(said)
    assert words in str(refused.value)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=9),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=9), inner, max_size=3)
    ),
    max_leaves=6,
)
OPS = st.sampled_from(['subscribe', 'advertise', 'setParameters', 'getParameters', 'fetchAsset'])
KEYS = ['subscriptions', 'channels', 'parameters', 'parameterNames', 'id', 'uri', 'requestId']


@settings(max_examples=40)
@given(st.binary(max_size=60) | st.text(max_size=60))
def test_noise_is_refused_and_nothing_else(said):
    try:
        parsed(said)
    except ProtocolError:
        return


@settings(max_examples=40)
@given(OPS, st.dictionaries(st.sampled_from(KEYS), JSON, max_size=4))
def test_odd_values_are_refused_and_nothing_else(op, told):
    try:
        parsed(json.dumps(told | {'op': op}))
    except ProtocolError:
        return
