"""The values of the shipped configuration, as arguments of nodes that a program makes."""

from __future__ import annotations

from typing import Any

from agv_motion.files import yaml_text
from agv_motion.ros.config import find_config
from agv_motion.ros.run import overrides


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
