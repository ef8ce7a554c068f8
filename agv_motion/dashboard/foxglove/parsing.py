"""What a client says in the Foxglove websocket protocol, taken apart strictly.

What is not as it should be is refused in words that name it; nothing is guessed.
"""

from __future__ import annotations

import json
from math import isfinite
from struct import Struct
from typing import TYPE_CHECKING, Any, NoReturn

from agv_motion.dashboard.foxglove.requests import (
    Advertise,
    Call,
    ClientChannel,
    Control,
    FetchAsset,
    GetParameters,
    ProtocolError,
    Publish,
    SetParameters,
    Subscribe,
    Unadvertise,
    Unsubscribe,
    WatchGraph,
    WatchParameters,
)
from agv_motion.errors import shortened

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.dashboard.foxglove.requests import Request

MOST = 5000
"""entries of one list"""
LONGEST_NAME = 512
"""characters of a topic, a parameter, an id"""
WORD = 2**32
_PUBLISH, _CALL, _CONTROL = Struct('<I'), Struct('<III'), Struct('<BfBQI')


def parsed(message: str | bytes) -> Request:
    """Return what a client says.

    Raises:
        ProtocolError: It is nothing of the protocol.

    """
    return _binary(message) if isinstance(message, bytes) else _text(message)


def _text(message: str) -> Request:
    try:
        told = json.loads(message, parse_constant=_no_number, parse_float=_number)
    except (ValueError, RecursionError) as error:
        msg = f'no JSON: {shortened(str(error))}'
        raise ProtocolError(msg) from error
    if not isinstance(told, dict):
        msg = f'expected a JSON object with the key op, got {type(told).__name__}'
        raise ProtocolError(msg)
    op = told.get('op')
    make = _OPS.get(op) if isinstance(op, str) else None
    if make is None:
        msg = f'op {shortened(repr(op))} is not known; there are {", ".join(_OPS)}'
        raise ProtocolError(msg)
    return make(told)


def _no_number(name: str) -> NoReturn:
    msg = f'{name} is no number of JSON'
    raise ValueError(msg)


def _number(text: str) -> float:
    value = float(text)
    if not isfinite(value):
        msg = f'{shortened(text)} is beyond every number'
        raise ValueError(msg)
    return value


def _binary(message: bytes) -> Request:
    make = _OPCODES.get(message[0]) if message else None
    if make is None:
        what = f'opcode {message[0]} is not known' if message else 'an empty message'
        msg = f'{what}; there are {", ".join(map(str, _OPCODES))}'
        raise ProtocolError(msg)
    return make(message)


def _publish(message: bytes) -> Publish:
    (channel,) = _head(_PUBLISH, message)
    return Publish(channel, message[1 + _PUBLISH.size :])


def _call(message: bytes) -> Call:
    service, number, size = _head(_CALL, message)
    encoding, data = _name(message, 1 + _CALL.size, size)
    return Call(service, number, encoding, data)


def _control(message: bytes) -> Control:
    command, speed, seeks, stamp, size = _head(_CONTROL, message)
    number, _ = _name(message, 1 + _CONTROL.size, size)
    if command > 1:
        msg = f'playback command {command}: must be 0 (play) or 1 (pause)'
        raise ProtocolError(msg)
    if not isfinite(speed):
        msg = f'playback speed {speed}: must be a finite number'
        raise ProtocolError(msg)
    return Control(command == 0, float(speed), stamp if seeks else None, number)


def _head(form: Struct, message: bytes) -> tuple[Any, ...]:
    if len(message) <= form.size:
        msg = f'opcode {message[0]} in {len(message)} bytes: needs at least {1 + form.size}'
        raise ProtocolError(msg)
    return form.unpack_from(message, 1)


def _name(message: bytes, start: int, size: int) -> tuple[str, bytes]:
    """Return a text of ``size`` bytes, and what comes after it."""
    end = start + size
    if size > LONGEST_NAME or end > len(message):
        msg = f'a text of {size} bytes in a message of {len(message)}: at most {LONGEST_NAME}'
        raise ProtocolError(msg)
    try:
        return message[start:end].decode(), message[end:]
    except UnicodeDecodeError as error:
        msg = f'a text that is not UTF-8: {message[start:end][:40]!r}'
        raise ProtocolError(msg) from error


_OPCODES: dict[int, Callable[[bytes], Request]] = {1: _publish, 2: _call, 3: _control}


def _listed(told: dict[str, Any], key: str) -> list[Any]:
    value = told.get(key)
    if not isinstance(value, list):
        msg = f'{told["op"]}: {key} = {shortened(repr(value))}: expected a list'
        raise ProtocolError(msg)
    if len(value) > MOST:
        msg = f'{told["op"]}: {key} has {len(value)} entries: at most {MOST}'
        raise ProtocolError(msg)
    return value


def _entries(told: dict[str, Any], key: str) -> list[dict[str, Any]]:
    rows = _listed(told, key)
    for row in rows:
        if not isinstance(row, dict):
            msg = f'{told["op"]}: {key} holds {shortened(repr(row))}: expected objects'
            raise ProtocolError(msg)
    return rows


def _whole(op: str, key: str, value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < WORD:
        msg = f'{op}: {key} = {shortened(repr(value))}: expected a whole number in [0, {WORD - 1}]'
        raise ProtocolError(msg)
    return value


def _wholes(told: dict[str, Any], key: str) -> list[int]:
    return [_whole(told['op'], key, one) for one in _listed(told, key)]


def _words(op: str, key: str, value: Any, *, least: int = 1) -> str:
    if not isinstance(value, str) or not least <= len(value) <= LONGEST_NAME:
        msg = (
            f'{op}: {key} = {shortened(repr(value))}: expected a text of {least} to '
            f'{LONGEST_NAME} characters'
        )
        raise ProtocolError(msg)
    return value


def _names(told: dict[str, Any]) -> list[str]:
    op, key = told['op'], 'parameterNames'
    return [_words(op, key, one) for one in _listed(told, key)]


def _id(told: dict[str, Any]) -> str:
    value = told.get('id')
    return '' if value is None else _words(told['op'], 'id', value, least=0)


def _subscribe(told: dict[str, Any]) -> Subscribe:
    pairs = {}
    for row in _entries(told, 'subscriptions'):
        number = _whole('subscribe', 'id', row.get('id'))
        if number in pairs:
            msg = f'subscribe: id {number} comes twice'
            raise ProtocolError(msg)
        pairs[number] = _whole('subscribe', 'channelId', row.get('channelId'))
    return Subscribe(pairs)


def _advertise(told: dict[str, Any]) -> Advertise:
    op = 'advertise'
    return Advertise([
        ClientChannel(
            _whole(op, 'id', row.get('id')), _words(op, 'topic', row.get('topic')),
            _words(op, 'encoding', row.get('encoding')),
            _words(op, 'schemaName', row.get('schemaName')),
        )
        for row in _entries(told, 'channels')
    ])  # fmt: skip


def _set_parameters(told: dict[str, Any]) -> SetParameters:
    op = 'setParameters'
    values = {}
    for row in _entries(told, 'parameters'):
        name = _words(op, 'name', row.get('name'))
        values[name] = _value(name, row.get('value'), row.get('type'))
    return SetParameters(values, _id(told))


def _value(name: str, value: Any, kind: Any) -> Any:
    """Return the value of a parameter, of the type that is told with it."""
    shown = f'setParameters: {name} = {shortened(repr(value))}'
    if value is None:
        msg = f'{shown}: a parameter of a node cannot be removed'
        raise ProtocolError(msg)
    if kind not in {None, 'float64', 'float64_array'}:
        msg = f'{shown}: type {shortened(repr(kind))} is not taken'
        raise ProtocolError(msg)
    rows = value if isinstance(value, list) else [value]
    if any(not isinstance(one, (bool, int, float, str)) for one in rows):
        msg = f'{shown}: expected a number, a text, true or false, or a list of one of these'
        raise ProtocolError(msg)
    if kind is None:
        return value
    if (kind == 'float64_array') != isinstance(value, list) or any(
        isinstance(one, (bool, str)) for one in rows
    ):
        msg = f'{shown}: is no {kind}'
        raise ProtocolError(msg)
    try:
        floats = [float(one) for one in rows]
    except OverflowError as error:
        msg = f'{shown}: is beyond every number'
        raise ProtocolError(msg) from error
    return floats if isinstance(value, list) else floats[0]


_OPS: dict[str, Callable[[dict[str, Any]], Request]] = {
    'subscribe': _subscribe,
    'unsubscribe': lambda told: Unsubscribe(_wholes(told, 'subscriptionIds')),
    'advertise': _advertise,
    'unadvertise': lambda told: Unadvertise(_wholes(told, 'channelIds')),
    'getParameters': lambda told: GetParameters(_names(told), _id(told)),
    'setParameters': _set_parameters,
    'subscribeParameterUpdates': lambda told: WatchParameters(_names(told), on=True),
    'unsubscribeParameterUpdates': lambda told: WatchParameters(_names(told), on=False),
    'subscribeConnectionGraph': lambda _: WatchGraph(on=True),
    'unsubscribeConnectionGraph': lambda _: WatchGraph(on=False),
    'fetchAsset': lambda told: FetchAsset(
        _words('fetchAsset', 'uri', told.get('uri')),
        _whole('fetchAsset', 'requestId', told.get('requestId')),
    ),
}
