"""Nodes of a demo with the values of the shipped configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from agv_motion.files import yaml_text
from agv_motion.ros.config import find_config
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import overrides

if TYPE_CHECKING:
    from agv_motion.ros.plain_node import PlainNode

N = TypeVar('N', bound='PlainNode[Any]')


def configured_node(
    kind: type[N], file: str, changes: dict[str, Any], **kwargs: Any
) -> LiveNode[N]:
    """Return a node with its values in ``file`` of config/, then ``changes``.

    Args:
        kind: Of the plain node.
        file: Of the configuration.
        changes: Of parameters, by name; ``__`` stands for the dot of a group.
        kwargs: Of rclpy, such as ``namespace``.

    """
    return LiveNode(kind, **configured(file, kind.name, changes), **kwargs)


def configured(file: str, node: str, changes: dict[str, Any]) -> dict[str, Any]:
    """Return the arguments of a node: its values in ``file`` of config/, then ``changes``.

    What stands under ``/**`` is for all nodes: first that, then what the node has of its own.
    """
    content = yaml_text.load(find_config(file)).value
    sections = [content[name]['ros__parameters'] for name in ('/**', f'/**/{node}')
                if name in content]  # fmt: skip
    values: dict[str, Any] = {}
    for section in sections:
        values |= _flat(section)
    return {'parameter_overrides': overrides(**(values | changes))}


def _flat(values: dict[str, Any], prefix: str = '') -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for name, value in values.items():
        if isinstance(value, dict):
            flat |= _flat(value, f'{prefix}{name}__')
        else:
            flat[prefix + name] = value
    return flat
