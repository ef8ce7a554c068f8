"""Which nodes there are in this package, and the parameters of each."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

from agv_motion.errors import ConfigurationError
from agv_motion.ros.suggestion import meant


def available() -> list[str]:
    """Return the names of the nodes of this package."""
    return sorted(
        path.stem
        for path in Path(__file__).parent.glob('*.py')
        if '\ndef main()' in path.read_text('utf-8')
    )


def require_node(name: str) -> None:
    """Raise unless there is a node of this name.

    Raises:
        ConfigurationError: There is none; the message lists those there are.

    """
    if name not in available():
        msg = f"no node '{name}'{meant(name, available())}; there are {', '.join(available())}"
        raise ConfigurationError(msg)


def parameters_of(node: str) -> type[Any]:
    """Return the parameter dataclass of a node of this package."""
    require_node(node)
    module = importlib.import_module(f'agv_motion.nodes.{node}')
    name = ''.join(word.capitalize() for word in node.split('_')) + 'Parameters'
    kind: type[Any] = getattr(module, name)
    return kind
