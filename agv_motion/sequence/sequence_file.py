"""Sequences from YAML, with errors that name line, column and the valid choices."""

from __future__ import annotations

import difflib
from dataclasses import MISSING, dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, get_args

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.files import yaml_text
from agv_motion.files.marked import quoted
from agv_motion.parameters import rows
from agv_motion.route.route import Route
from agv_motion.route.route_file import load_route
from agv_motion.sequence.actions import DriveArc, FollowRoute, GoTo, Rotate, Wait
from agv_motion.sequence.sequence import OnFailure, Sequence, SequenceStep

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.files.marked import Marked
    from agv_motion.sequence.actions import Action

ACTIONS: dict[str, type[Any]] = {
    'go_to': GoTo, 'rotate': Rotate, 'arc': DriveArc, 'follow_route': FollowRoute, 'wait': Wait,
}  # fmt: skip
ROUTE_KEYS = ('file', 'waypoints', 'laps')
OPTIONS = ('timeout', 'on_failure', 'name')
LONGEST = 1e6
"""[s]"""


@dataclass(frozen=True)
class Defaults:
    """What holds for every action that does not say otherwise."""

    timeout: float
    on_failure: OnFailure
    keys: dict[str, dict[str, Any]]
    """of each action"""


def load_sequence(path: str | Path) -> Sequence:
    """Return the sequence of a file.

    It holds ``actions``, a list, and if wanted ``name`` and ``defaults``. Each action is one of
    :data:`ACTIONS` with its keys, and beside it ``timeout`` [s], ``on_failure`` and ``name``.

    Raises:
        ConfigurationError: The file cannot be read or says something that cannot be done; the
            message gives line, column and what may stand there.

    """
    file = yaml_text.load(Path(path), 'the sequence')
    content = file.mapping('the file')
    _require_known(content, ('name', 'defaults', 'actions'), 'the file')
    if 'actions' not in content:
        _refuse(file, 'no actions: give a list of them')
    defaults = _defaults(content['defaults'][1] if 'defaults' in content else None)
    items = content['actions'][1].items('actions')
    if not items:
        _refuse(content['actions'][1], 'actions: the list is empty')
    name = _name(content['name'][1]) if 'name' in content else Path(path).stem
    return Sequence(name, tuple(_step(item, defaults) for item in items))


def _defaults(marked: Marked | None) -> Defaults:
    found = {} if marked is None else marked.mapping('defaults')
    _require_known(found, ('timeout', 'on_failure', *ACTIONS), 'defaults')
    given = {
        action: _given(found[action][1], ACTIONS[action], action)
        for action in ACTIONS
        if action in found and ACTIONS[action] is not FollowRoute
    }
    return Defaults(_timeout(found, 60.0), _on_failure(found, OnFailure()), given)


def _step(item: Marked, defaults: Defaults) -> SequenceStep:
    found = item.mapping('an action')
    kinds = [key for key in found if key not in OPTIONS]
    if len(kinds) != 1:
        _refuse(item, f'{len(kinds)} actions in one item: give one of {", ".join(ACTIONS)}')
    kind = kinds[0]
    key, marked = found[kind]
    if kind not in ACTIONS:
        choices = f'choose one of {", ".join(ACTIONS)}'
        key.refuse(
            f"unknown action '{kind:.80}'{_meant(kind, ACTIONS)}; {choices}",
            f'unknown action; {choices}',
        )
    action = _action(kind, marked, defaults.keys.get(kind, {}))
    name = _name(found['name'][1]) if 'name' in found else _words(kind, marked)
    return SequenceStep(
        name,
        action,
        _timeout(found, defaults.timeout),
        _on_failure(found, defaults.on_failure),
        key.where,
    )


def _name(marked: Marked) -> str:
    if isinstance(marked.value, (dict, list)):
        marked.refuse(f'name = {quoted(marked.value)}: expected text', 'name: expected text')
    return f'{marked.value!s:.80}'


def _words(kind: str, marked: Marked) -> str:
    """Return an action as people would say it: `go_to x 1, y 2`."""
    value = marked.value
    if not isinstance(value, dict):
        return f'{kind} {quoted(value)}' if isinstance(value, list) else f'{kind} {value!s:.80}'
    return f'{kind} ' + ', '.join(
        f'{key} {given:g}' if isinstance(given, float) else f'{key:.80} {given!s:.80}'
        for key, given in value.items()
        if not isinstance(given, (dict, list))
    )


def _action(kind: str, marked: Marked, defaults: dict[str, Any]) -> Action:
    if kind == 'follow_route':
        return FollowRoute(_route(marked))
    given = defaults | _given(marked, ACTIONS[kind], kind)
    missing = [
        field.name
        for field in fields(ACTIONS[kind])
        if field.default is MISSING and field.name not in given
    ]
    if missing:
        _refuse(marked, f"{kind}: '{missing[0]}' is missing; it has {_explained(kind)}")
    try:
        action: Action = ACTIONS[kind](**given)
    except ConfigurationError as error:
        _refuse(_culprit(marked, str(error)), f'{kind}: {error}')
    return action


def _culprit(marked: Marked, reason: str) -> Marked:
    """Return the value that ``reason`` begins with, if it stands here."""
    found = marked.mapping('an action') if isinstance(marked.value, dict) else {}
    name = reason.partition(' ')[0]
    return found[name][1] if name in found else marked


def _given(marked: Marked, kind: type[Any], name: str) -> dict[str, Any]:
    """Return the keys that a mapping gives to an action, each of its type and in its range."""
    if kind is Wait and not isinstance(marked.value, dict):
        return {'seconds': marked.typed(name, float)}
    known = {field: origin for field, origin, _ in rows(kind)}
    found = marked.mapping(name)
    for key, (mark, _) in found.items():
        if key not in known:
            has = f'it has {_explained(name)}'
            mark.refuse(
                f"{name}: unknown key '{key:.80}'{_meant(key, known)}; {has}",
                f'{name}: unknown key; {has}',
            )
    return {
        key: value.typed(f'{name}: {key}', (get_args(known[key]) or (known[key],))[0])
        for key, (_, value) in found.items()
    }


def _route(marked: Marked) -> Route:
    found = marked.mapping('follow_route')
    _require_known(found, ROUTE_KEYS, 'follow_route')
    if ('file' in found) == ('waypoints' in found):
        _refuse(marked, 'follow_route: give either file or waypoints: [[x, y], ...]')
    laps = found['laps'][1].typed('follow_route: laps', int) if 'laps' in found else 1
    try:
        if 'file' in found:
            name = found['file'][1].typed('follow_route: file', str)
            return load_route(Path(marked.path).parent / name, laps)
        points = found['waypoints'][1].items('waypoints')
        return Route([pair.point(f'waypoint {i}') for i, pair in enumerate(points, 1)], laps)
    except (ConfigurationError, GeometryError) as error:
        if str(error).startswith(f'{marked.path}, line'):
            raise
        marked.refuse(f'follow_route: {error}', f'follow_route: {error.unquoted or error}')


def _timeout(found: dict[str, tuple[Marked, Marked]], default: float) -> float:
    if 'timeout' not in found:
        return default
    marked = found['timeout'][1]
    seconds = float(marked.typed('timeout', float))
    if not 0.0 < seconds <= LONGEST:
        _refuse(marked, f'timeout = {seconds:g} s: must lie above 0, at most {LONGEST:g}')
    return seconds


def _on_failure(found: dict[str, tuple[Marked, Marked]], default: OnFailure) -> OnFailure:
    if 'on_failure' not in found:
        return default
    marked = found['on_failure'][1]
    words = marked.typed('on_failure', str)
    try:
        return OnFailure.parse(words)
    except ConfigurationError as error:
        marked.refuse(
            str(error), 'on_failure: choose one of stop, skip, retry N, retry N then skip'
        )


def _require_known(
    found: dict[str, tuple[Marked, Marked]], known: tuple[str, ...], what: str
) -> None:
    for key, (marked, _) in found.items():
        if key not in known:
            there = f'there are {", ".join(known)}'
            marked.refuse(
                f"{what}: unknown key '{key:.80}'{_meant(key, known)}; {there}",
                f'{what}: unknown key; {there}',
            )


def _refuse(marked: Marked, reason: str) -> NoReturn:
    """Raise a reason in which no word of the file stands, or only numbers of a sequence."""
    marked.refuse(reason, reason)


def _explained(name: str) -> str:
    kind = ACTIONS[name]
    if kind is FollowRoute:
        return ', '.join(ROUTE_KEYS)
    return ', '.join(f'{key} [{spec.unit}]' if spec.unit not in {'', '1'} else key
                     for key, _, spec in rows(kind))  # fmt: skip


def _meant(word: str, choices: Iterable[str]) -> str:
    close = difflib.get_close_matches(word[:80], list(choices), cutoff=0.5)
    return f", did you mean '{close[0]}'?" if close else ''
