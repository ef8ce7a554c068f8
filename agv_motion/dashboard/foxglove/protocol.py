"""What the server says in the Foxglove websocket protocol, v1: texts of JSON, and bytes.

All that is binary is little-endian. Sources: github.com/foxglove/ws-protocol, docs/spec.md (before
its removal in 2025), and github.com/foxglove/foxglove-sdk, rust/foxglove/src/protocol, for the
control of playback, which only the newer of the two names of the protocol has.
"""

from __future__ import annotations

import json
from enum import Enum, IntEnum
from math import isfinite
from struct import Struct
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

NEWER, OLDER = 'foxglove.sdk.v1', 'foxglove.websocket.v1'
SUBPROTOCOLS = NEWER, OLDER
"""Names of the protocol, the better one first: Foxglove speaks the first, Lichtblick the second."""
CDR, DEFINITION = 'cdr', 'ros2msg'
"""How messages and their definitions are coded"""
SECOND = 1_000_000_000

_TIME, _ANSWER = Struct('<BQ'), Struct('<BIII')
_ASSET, _STATE = Struct('<BIBI'), Struct('<BBQfBI')
LONGEST = 1000
"""characters of a text that is told"""


class Capability(Enum):
    """What a server can do beside sending messages."""

    PUBLISH = 'clientPublish'
    PARAMETERS = 'parameters'
    WATCH_PARAMETERS = 'parametersSubscribe'
    TIME = 'time'
    SERVICES = 'services'
    GRAPH = 'connectionGraph'
    PLAYBACK = 'playbackControl'


class Severity(IntEnum):
    """How grave a status is."""

    INFO = 0
    WARNING = 1
    ERROR = 2


class PlaybackStatus(IntEnum):
    """What a recording does that is played."""

    PLAYING = 0
    PAUSED = 1
    BUFFERING = 2
    ENDED = 3


class ChannelInfo(NamedTuple):
    """What a client is told of a topic."""

    id: int
    topic: str
    type: str
    """such as ``geometry_msgs/msg/Twist``"""
    definition: str
    """its text, with all that it uses"""
    encoding: str = CDR
    definition_encoding: str = DEFINITION


class ServiceInfo(NamedTuple):
    """What a client is told of a service."""

    id: int
    name: str
    type: str
    """such as ``std_srvs/srv/SetBool``"""
    request: str
    """definition"""
    response: str
    """definition"""


class ConnectionGraph(NamedTuple):
    """Which nodes speak on a topic, listen to it, or offer a service; by its name."""

    published: dict[str, tuple[str, ...]]
    subscribed: dict[str, tuple[str, ...]]
    services: dict[str, tuple[str, ...]]


NO_GRAPH = ConnectionGraph({}, {}, {})


def server_info(
    name: str, capabilities: Sequence[Capability], session: str,
    span: tuple[int, int] | None = None, metadata: Mapping[str, str] | None = None,
) -> str:  # fmt: skip
    """Return the first message to a client.

    Args:
        name: Of the server.
        capabilities: What this client may use.
        session: The same as before tells a client that it has come back to the same server.
        span: Log times of the first and the last message [ns], of a recording that is played.
        metadata: More that is told, in words.

    """
    told: dict[str, Any] = {
        'op': 'serverInfo', 'name': name, 'capabilities': [one.value for one in capabilities],
        'metadata': dict(metadata or {}), 'sessionId': session,
    }  # fmt: skip
    if {Capability.PUBLISH, Capability.SERVICES} & set(capabilities):
        told['supportedEncodings'] = [CDR]
    if span is not None:
        for key, stamp in zip(('dataStartTime', 'dataEndTime'), span, strict=True):
            seconds, rest = divmod(stamp, SECOND)
            told[key] = {'sec': seconds, 'nsec': rest}
    return _text(told)


def status(level: Severity, message: str, number: str = '') -> str:
    """Return a word to the client; a later one of the same ``number`` replaces it."""
    told = {'op': 'status', 'level': int(level), 'message': message[:LONGEST]}
    return _text(told | ({'id': number} if number else {}))


def advertise(channels: Iterable[ChannelInfo]) -> str:
    """Return that there are channels."""
    rows = [
        {
            'id': one.id, 'topic': one.topic, 'encoding': one.encoding, 'schemaName': one.type,
            'schema': one.definition, 'schemaEncoding': one.definition_encoding,
        }
        for one in channels
    ]  # fmt: skip
    return _text({'op': 'advertise', 'channels': rows})


def unadvertise(numbers: Iterable[int]) -> str:
    """Return that channels are there no more."""
    return _text({'op': 'unadvertise', 'channelIds': list(numbers)})


def advertise_services(services: Iterable[ServiceInfo]) -> str:
    """Return that there are services; older clients read the plain definitions."""
    rows = []
    for one in services:
        row: dict[str, Any] = {'id': one.id, 'name': one.name, 'type': one.type}
        for side, definition in (('request', one.request), ('response', one.response)):
            row[side] = {
                'encoding': CDR, 'schemaName': f'{one.type}_{side.capitalize()}',
                'schemaEncoding': DEFINITION, 'schema': definition,
            }  # fmt: skip
            row[f'{side}Schema'] = definition
        rows.append(row)
    return _text({'op': 'advertiseServices', 'services': rows})


def unadvertise_services(numbers: Iterable[int]) -> str:
    """Return that services are there no more."""
    return _text({'op': 'unadvertiseServices', 'serviceIds': list(numbers)})


def service_failure(service: int, call: int, message: str) -> str:
    """Return why there is no response to a call."""
    return _text({
        'op': 'serviceCallFailure', 'serviceId': service, 'callId': call,
        'message': message[:LONGEST],
    })  # fmt: skip


def parameter_values(values: Mapping[str, Any], number: str = '') -> str:
    """Return values of parameters; ``number`` is that of the request, if one is answered.

    A parameter that has no value, or none that JSON has, is told without one.
    """
    rows = []
    for name, value in values.items():
        row: dict[str, Any] = {'name': name}
        if _is_plain(value):
            row['value'] = value
            if isinstance(value, float):
                row['type'] = 'float64'
            elif isinstance(value, list) and value and isinstance(value[0], float):
                row['type'] = 'float64_array'
        rows.append(row)
    told = {'op': 'parameterValues', 'parameters': rows}
    return _text(told | ({'id': number} if number else {}))


def graph_update(now: ConnectionGraph, before: ConnectionGraph = NO_GRAPH) -> str:
    """Return what has changed of the graph; empty if nothing has."""
    told: dict[str, Any] = {'op': 'connectionGraphUpdate'}
    words = ('publishedTopics', 'publisherIds'), ('subscribedTopics', 'subscriberIds'), (
        'advertisedServices', 'providerIds')  # fmt: skip
    for (key, whose), is_now, was in zip(words, now, before, strict=True):
        told[key] = [
            {'name': name, whose: list(is_now.get(name, ()))}
            for name in sorted(is_now.keys() | was.keys()) if is_now.get(name) != was.get(name)
        ]  # fmt: skip
    topics, topics_before = (one.published | one.subscribed for one in (now, before))
    told['removedTopics'] = sorted(topics_before.keys() - topics.keys())
    told['removedServices'] = sorted(before.services.keys() - now.services.keys())
    return _text(told) if any(told[key] for key in told if key != 'op') else ''


def time_data(stamp: int) -> bytes:
    """Return the time of the robots' clock [ns]."""
    return _TIME.pack(2, stamp)


def service_response(service: int, call: int, encoding: str, data: bytes) -> bytes:
    """Return the response to a call."""
    name = encoding.encode()
    return _ANSWER.pack(3, service, call, len(name)) + name + data


def asset_refusal(request: int, message: str) -> bytes:
    """Return why a file is not given out."""
    words = message.encode()
    return _ASSET.pack(4, request, 1, len(words)) + words


def playback_state(
    what: PlaybackStatus, stamp: int, speed: float, *, leapt: bool = False, number: str = ''
) -> bytes:
    """Return where the playback of a recording stands.

    Args:
        what: It does.
        stamp: Log time up to which it has come [ns].
        speed: Seconds of the recording in a second.
        leapt: Whether it went elsewhere, so that what was drawn before is void.
        number: Of the request that is answered, if one is.

    """
    words = number.encode()
    return _STATE.pack(5, what, stamp, speed, leapt, len(words)) + words


def _is_plain(value: Any) -> bool:
    if isinstance(value, list):
        return all(map(_is_plain, value))
    if isinstance(value, float):
        return isfinite(value)
    return isinstance(value, (bool, int, str))


def _text(told: dict[str, Any]) -> str:
    return json.dumps(told, separators=(',', ':'), allow_nan=False)
