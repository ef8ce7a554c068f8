"""Parameters of a node from a ROS parameter file, without starting the node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from agv_motion.errors import ConfigurationError
from agv_motion.files.marked import quoted
from agv_motion.parameters import moved, nested, rows
from agv_motion.ros.parameter_arguments import sections
from agv_motion.ros.suggestion import meant
from agv_motion.ros.yaml_readings import as_written

if TYPE_CHECKING:
    from pathlib import Path

    from _typeshed import DataclassInstance

T = TypeVar('T', bound='DataclassInstance')


def load_parameters(path: Path, node: str, kind: type[T]) -> T:
    """Return the parameters that ``path`` gives to ``node``, defaults for the rest.

    What stands under ``/**`` is for all nodes, each takes of it what it has.

    Args:
        path: A ROS parameter file.
        node: Its section may stand for any namespace: ``/**/node``, ``/oak/node``, ``node``.
        kind: Dataclass of rows and groups.

    Raises:
        ConfigurationError: The file cannot be read, has no section for the node, names a parameter
            that there is not, or a value is of another type or refused by its row.

    """
    found = sections(path)
    own = [(key, values) for key, values in found if key.rpartition('/')[2] in {node, '**'}]
    robots = sorted({key.rpartition('/')[0] for key, _ in own} - {'', '/**'})
    if len(robots) > 1:
        msg = f'{path}: {node} of several robots, {", ".join(robots)}: give a file with one of them'
        raise ConfigurationError(msg)
    if own:
        return _build(kind, _merged(own, node, kind), f'{path}: ', '')
    there = ', '.join(key for key, _ in found) or 'nothing'
    msg = f'{path}: no section /**/{node} with ros__parameters; there is {there:.200}'
    raise ConfigurationError(msg)


def _merged(
    found: list[tuple[str, dict[str, Any]]], node: str, kind: type[DataclassInstance]
) -> dict[str, Any]:
    """Return the parameters of a node; of what is for all nodes, those that it has."""
    known = {*(name for name, _, _ in rows(kind)), *dict(nested(kind))}
    alone = all(key.rpartition('/')[2] != node for key, _ in found)
    merged: dict[str, Any] = {}
    for key, values in found:
        own = alone or key.rpartition('/')[2] == node
        merged |= {name: value for name, value in values.items() if own or name in known}
    return merged


def _build(kind: type[T], values: dict[str, Any], where: str, prefix: str) -> T:
    plain = {name: (origin, spec.unit) for name, origin, spec in rows(kind)}
    groups = dict(nested(kind))
    given: dict[str, Any] = {}
    for name, value in values.items():
        if name in groups and isinstance(value, dict):
            given[name] = _build(groups[name], value, where, f'{prefix}{name}.')
        elif name in plain:
            given[name] = _typed(value, *plain[name], f'{where}{prefix}{name}')
        else:
            first = next(iter(value), '') if isinstance(value, dict) else ''
            old = f'{prefix}{name}.{first}' if first else f'{prefix}{name}'
            if moved(old):
                msg = f'{where}no parameter {old} any more; it is {moved(old)} now'
                raise ConfigurationError(msg)
            msg = (
                f'{where}no parameter {prefix}{name}{meant(name, [*plain, *groups])}; '
                f'there are {", ".join([*plain, *groups])}'
            )
            raise ConfigurationError(msg)
    try:
        return kind(**given)
    except ConfigurationError as error:
        msg = f'{where}{error}'
        raise ConfigurationError(msg) from error


def _typed(value: Any, origin: Any, unit: str, where: str) -> Any:
    """Return a value as its row wants it; as ROS, take no 1 for 1.0."""
    value = as_written(value, origin, unit, None)
    if isinstance(value, list):
        value = tuple(value)
    wanted = tuple if getattr(origin, '__origin__', origin) is tuple else origin
    if type(value) is not wanted or (wanted is tuple and len(set(map(type, value))) > 1):
        shown = list(value) if isinstance(value, tuple) else value
        msg = f'{where} = {quoted(shown)}: expected {_name(wanted)}; ROS takes no 1 for 1.0'
        raise ConfigurationError(msg)
    return value


def _name(kind: type[Any]) -> str:
    return {
        float: 'a decimal number',
        int: 'a whole number',
        bool: 'true or false',
        str: 'text',
    }.get(kind, 'a list of values of one type')
