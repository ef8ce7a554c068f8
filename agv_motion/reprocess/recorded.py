"""Which class a node has on a recording, and which parameters a file gives to it."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.catalogue import available, parameters_of, require_node
from agv_motion.parameters import nested, rows
from agv_motion.ros.config import find_config
from agv_motion.ros.parameter_arguments import is_for, sections
from agv_motion.ros.plain_node import PlainNode

if TYPE_CHECKING:
    from collections.abc import Iterator

LIVE_ONLY = {'bag_player', 'bag_recorder', 'nav2_actions'}
"""nodes that are nothing without a graph"""

MODULES = {'granier_probe': 'agv_motion.reprocess.recorded_probe'}
"""of nodes that are others on a recording; the rest run as they do live"""

FILES = {
    'arbiter': 'state_file', 'granier_probe': 'state_file', 'motion_generator': 'memory_file',
}  # fmt: skip
"""parameter that names what a robot has learnt, or what holds it: that stays untouched"""


def module_of(name: str) -> str:
    """Return the module in which a node of this package is, for a recording."""
    return MODULES.get(name, f'agv_motion.nodes.{name}')


def node_class(name: str) -> Any:
    """Return the class of a node of this package, for a recording.

    Raises:
        ConfigurationError: There is none of this name, or it is nothing without a graph.

    """
    require_node(name)
    if name in LIVE_ONLY:
        usable = ', '.join(sorted(set(available()) - LIVE_ONLY))
        msg = f'{name} works on a live graph only; there are {usable}'
        raise ConfigurationError(msg)
    module = importlib.import_module(module_of(name))
    return next(
        each
        for each in vars(module).values()
        if isinstance(each, type)
        and issubclass(each, PlainNode)
        and each.__module__ == module.__name__
    )


def parameters(config: str, node: str, namespace: str = '/') -> dict[str, Any]:
    """Return the parameters of a node by dotted name, from a file as ROS takes it.

    Of what stands there for several nodes (``/**``, ``/oak/*``), those that the node has.

    Raises:
        ConfigurationError: The file is missing or no YAML, or gives parameters to this node on
            other robots only.

    """
    values: dict[str, Any] = {}
    if config:
        path = find_config(config)
        full = f'{namespace.rstrip("/")}/{node}'
        known = set(_dotted(parameters_of(node)))
        found = sections(path)
        for key, given in found:
            if is_for(key, full):
                shared = key.endswith('*')
                flat = dict(_flat(given, ''))
                values |= {n: v for n, v in flat.items() if n in known or not shared}
        others = [key for key, _ in found if key.rpartition('/')[2] == node]
        if others and not any(is_for(key, full) for key, _ in found):
            robots = ' or '.join(sorted({key.rpartition('/')[0] or '/' for key in others}))
            msg = f'{path} has nothing for {full}: it is for {robots}; give it by --namespace'
            raise ConfigurationError(msg)
    if node in FILES:
        values[FILES[node]] = ''
    return values


def all_parameters(config: str, full_name: str) -> dict[str, Any]:
    """Return all that a file gives to a node of somebody else, by dotted name.

    Raises:
        ConfigurationError: The file is missing or no YAML.

    """
    values: dict[str, Any] = {}
    for key, given in sections(find_config(config)) if config else ():
        if is_for(key, full_name):
            values |= dict(_flat(given, ''))
    return values


def _dotted(kind: type[Any], prefix: str = '') -> Iterator[str]:
    """Yield the names of a node's parameters, those of groups dotted."""
    yield from (prefix + name for name, _, _ in rows(kind))
    for name, group in nested(kind):
        yield from _dotted(group, f'{prefix}{name}.')


def _flat(values: dict[str, Any], prefix: str) -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if isinstance(value, dict):
            yield from _flat(value, f'{prefix}{name}.')
        else:
            yield prefix + name, value
