"""Who may come in: origins, sessions, tokens; and what is no message of the protocol."""

from __future__ import annotations

import struct
from contextlib import suppress

import pytest
from argon2 import PasswordHasher
from websockets.exceptions import ConnectionClosed

from agv_motion.dashboard.server.foxglove import parameters
from agv_motion.dashboard.server.users import Users

QUICK = PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
ADVERTISED = (
    '{"op":"advertise","channels":[{"id":1,"topic":"/cmd_vel/manual","encoding":"cdr",'
    '"schemaName":"geometry_msgs/msg/TwistStamped"}]}'
)
PASSWORD = 'a blue gate, 1905'  # noqa: S105 - of nobody


def users(store):
    made = Users(store, hasher=QUICK)
    for role in ('viewer', 'operator', 'expert'):
        made.add(f'{role}s', PASSWORD, role)
    return made


def test_pages_of_other_sites_come_in_only_if_they_are_listed(serve, connect):
    server = serve(origins=('https://app.example', 'file://'))
    for origin in (server.url, 'https://app.example', 'file://'):
        assert connect(server, origin=origin).info['name'] == 'agv_motion'
    for origin in ('https://evil.example', 'http://app.example', 'https://app.example:99', 'null',
                   'https://app.example.evil.example', 'http://127.0.0.1'):  # fmt: skip
        with pytest.raises(Exception, match='403'):
            connect(server, origin=origin)


def test_no_site_is_listed_by_itself_nor_for_other_doors(serve, connect):
    with pytest.raises(Exception, match='403'):
        connect(serve(), origin='https://app.foxglove.dev')
    server = serve(origins=('https://app.example',))
    for path in ('/live', '/robots/oak/drive', '/foxglove/'):
        with pytest.raises(Exception, match='403'):
            connect(server, path=path, origin='https://app.example')


def test_alone_it_is_at_the_root_too_and_there_is_no_page(serve, connect):
    server = serve(alone=True)
    assert connect(server, path='/').info
    with pytest.raises(Exception, match='403'):
        connect(server, path='/live')


def test_beyond_this_machine_a_token_is_needed(serve, connect):
    server = serve('192.168.1.4', users)
    known = server.site.access.users
    with pytest.raises(Exception, match='403'):
        connect(server)
    token = known.bearer_token('viewers', 'viewer', 1.0)
    assert connect(server, path=f'/foxglove?token={token}').info
    assert connect(server, subprotocols=['foxglove.sdk.v1', f'agv.token.{token}']).info
    for bad in (token[:-1], token.replace('viewer!', 'expert!', 1), '', 'x' * 5000, '!!!'):
        with pytest.raises(Exception, match=r'403|40\d|414'):
            connect(server, path=f'/foxglove?token={bad}')


def test_a_token_opens_no_other_door_and_ends_with_the_password(serve, connect):
    server = serve('192.168.1.4', users)
    known = server.site.access.users
    token = known.bearer_token('experts', 'expert', 1.0)
    with pytest.raises(Exception, match='403'):
        connect(server, path=f'/robots/oak/drive?token={token}')
    tool = connect(server, path=f'/foxglove?token={token}')
    known.set_password('experts', 'another gate, 1906')
    assert 'session has ended' in tool.refusal()
    with pytest.raises(Exception, match='403'):
        connect(server, path=f'/foxglove?token={token}')


@pytest.mark.parametrize(
    ('role', 'acts', 'may'),
    [('viewer', True, False), ('operator', True, True), ('operator', False, False),
     ('expert', False, False)],
)  # fmt: skip
def test_who_may_act(serve, connect, role, acts, may):
    server = serve('192.168.1.4', users, acts=acts)
    token = server.site.access.users.bearer_token(f'{role}s', role, 1.0)
    tool = connect(server, path=f'/foxglove?token={token}')
    assert ('clientPublish' in tool.info['capabilities']) is may
    assert ('supportedEncodings' in tool.info) is may


def test_a_token_has_no_more_than_its_role_and_its_user(serve, connect):
    server = serve('192.168.1.4', users, acts=True)
    known = server.site.access.users
    for name, role in (('experts', 'viewer'), ('viewers', 'expert')):
        token = known.bearer_token(name, role, 1.0)
        tool = connect(server, path=f'/foxglove?token={token}')
        assert 'services' not in tool.info['capabilities']


@pytest.mark.parametrize(
    ('said', 'words'),
    [
        ('nonsense', 'no JSON'), ('{"op":"explode"}', "op 'explode' is not known"),
        (b'\x63', 'opcode 99'), (b'', 'empty message'),
        ('{"op":"subscribe","subscriptions":[{"id":1,"channelId":77}]}', 'there is no channel 77'),
        ('{"op":"unsubscribe","subscriptionIds":[9]}', 'there is no subscription 9'),
        ('{"op":"unadvertise","channelIds":[3]}', 'there is no channel 3 of yours'),
        ('{"op":"setParameters","parameters":[{"name":"/n.a","value":NaN}]}', 'NaN'),
        ('{"op":"setParameters","parameters":[{"name":"/n.a","value":1}]}', 'by an expert only'),
        ('{"op":"getParameters","parameterNames":["/nobody.x"]}', "no parameter '/nobody.x'"),
        (ADVERTISED, 'only shows'),
        (struct.pack('<BI', 1, 1) + b'x', 'there is no channel 1 of yours'),
        (struct.pack('<BBfBQI', 3, 0, 1.0, 0, 0, 0), 'this is live'),
    ],
)  # fmt: skip
def test_what_is_none_of_the_protocol_is_told_and_the_client_stays(kept_tool, said, words):
    kept_tool.socket.send(said)
    assert words in kept_tool.refusal()


@pytest.fixture
def kept_tool(serve, connect):
    return connect(serve())


def test_calls_and_files_that_are_not_there_are_answered(kept_tool):
    kept_tool.socket.send(struct.pack('<BIII', 2, 5, 6, 3) + b'cdr')
    told = kept_tool.wait('serviceCallFailure')
    assert (told['serviceId'], told['callId']) == (5, 6)
    assert 'no service 5' in told['message']
    kept_tool.ask('fetchAsset', uri='package://x/y.dae', requestId=4)
    assert b'no files' in kept_tool.wait('asset')['bytes']


def test_a_huge_message_ends_the_connection(kept_tool):
    kept_tool.socket.send('x' * 70_000)
    assert kept_tool.closed().code in {1009, 1006}


def test_a_flood_ends_the_connection(kept_tool):
    with suppress(ConnectionClosed):
        for _ in range(6000):
            kept_tool.socket.send('{"op":"unsubscribe","subscriptionIds":[]}')
    assert kept_tool.closed().code in {1008, 1006}


@pytest.mark.parametrize(
    ('said', 'words'),
    [
        ({'op': 'unsubscribe', 'subscriptionIds': [7] * 5000}, 'no subscription 7'),
        ({'op': 'unadvertise', 'channelIds': [7] * 5000}, 'no channel 7 of yours'),
        ({'op': 'subscribe',
          'subscriptions': [{'id': n, 'channelId': 7} for n in range(1500)]}, 'no channel 7'),
    ],
)  # fmt: skip
def test_of_thousands_of_refusals_some_are_told(kept_tool, said, words):
    """Each of them would cost the server a message, and everybody else the time."""
    kept_tool.ask(**said)
    for _ in range(5):
        assert words in kept_tool.refusal()
    count = len(next(rows for key, rows in said.items() if key != 'op'))
    assert f'and {count - 5} more' in kept_tool.refusal()
    kept_tool.ask('getParameters', parameterNames=['/nobody.x'])
    assert "no parameter '/nobody.x'" in kept_tool.refusal()


def test_a_flood_of_long_lists_ends_sooner(kept_tool):
    """A message of 60 kB counts as thirty."""
    names = [f'/a{n:0500}' for n in range(115)]
    with suppress(ConnectionClosed):
        for _ in range(200):
            kept_tool.ask('subscribeParameterUpdates', parameterNames=names)
    assert kept_tool.closed().code in {1008, 1006}


def test_names_that_are_watched_have_an_end(kept_tool, monkeypatch):
    monkeypatch.setattr(parameters, 'MOST_WATCHED', 10)
    kept_tool.ask('subscribeParameterUpdates', parameterNames=[f'/a.{n}' for n in range(11)])
    assert '10 parameters are watched' in kept_tool.refusal()
