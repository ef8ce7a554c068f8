"""Parameters of a node from a ROS parameter file, without starting the node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from agv_motion.cli.graph import meant
from agv_motion.errors import ConfigurationError
from agv_motion.files import yaml_text
from agv_motion.files.marked import quoted
from agv_motion.parameters import nested, rows

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
    content = yaml_text.load(path, 'the parameters').value
    sections = content if isinstance(content, dict) else {}
    own, shared = (_section(sections, name) for name in (node, '**'))
    if own and shared:
        known = {*(name for name, _, _ in rows(kind)), *dict(nested(kind))}
        own = {name: value for name, value in shared.items() if name in known} | own
    if own or shared:
        return _build(kind, own or shared or {}, f'{path}: ', '')
    found = ', '.join(sections) or 'nothing'
    msg = f'{path}: no section /**/{node} with ros__parameters; there is {found:.200}'
    raise ConfigurationError(msg)


def _section(sections: dict[Any, Any], node: str) -> dict[str, Any] | None:
    """Return the parameters under a name that ends in ``node``, None where there are none."""
    for name, section in sections.items():
        if str(name).split('/')[-1] == node and isinstance(section, dict):
            values = section.get('ros__parameters')
            if isinstance(values, dict):
                return values
    return None


def _build(kind: type[T], values: dict[str, Any], where: str, prefix: str) -> T:
    plain = {name: origin for name, origin, _ in rows(kind)}
    groups = dict(nested(kind))
    given: dict[str, Any] = {}
    for name, value in values.items():
        if name in groups and isinstance(value, dict):
            given[name] = _build(groups[name], value, where, f'{prefix}{name}.')
        elif name in plain:
            given[name] = _typed(value, plain[name], f'{where}{prefix}{name}')
        else:
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


def _typed(value: Any, origin: Any, where: str) -> Any:
    """Return a value as its row wants it; as ROS, take no 1 for 1.0."""
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
