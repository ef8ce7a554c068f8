"""The text of somebody's node: what it was, and what in it no guard of a running node sees."""

from __future__ import annotations

import ast
import hashlib
import importlib.util
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError
from agv_motion.reprocess.foreign.refusal import CLOCK

if TYPE_CHECKING:
    from collections.abc import Iterator

_NOW = {'now', 'utcnow', 'today'}
_HOLDERS = {'datetime', 'date'}


def files_of(target: str) -> list[Path]:
    """Return the files of the package, or the one file, in which a node is.

    Raises:
        ConfigurationError: It is not there, or ``target`` is no ``package.module:Class``.

    """
    module, mark, name = target.partition(':')
    if not (mark and name.isidentifier() and all(p.isidentifier() for p in module.split('.'))):
        msg = f"--node '{target}': give package.module:Class, such as my_robot.tracker:Tracker"
        raise ConfigurationError(msg)
    found = importlib.util.find_spec(module.partition('.')[0])
    if found is None:
        msg = f"--node {target}: '{module}' is not installed, and not in this folder"
        raise ConfigurationError(msg)
    if found.submodule_search_locations:
        places = map(Path, found.submodule_search_locations)
        return sorted(path for place in places for path in place.rglob('*.py'))
    return [Path(found.origin)] if found.origin else []


def digest(target: str) -> str:
    """Return the SHA-256 of the text of a node's package."""
    told = hashlib.sha256()
    for path in files_of(target):
        told.update(str(path).encode() + b'\0' + path.read_bytes())
    return told.hexdigest()


def require_no_dates(target: str) -> None:
    """Refuse a node whose file asks for the date of today.

    Raises:
        ConfigurationError: It does.

    """
    for path in files_of(target):
        if path.stem in (target.partition(':')[0].rpartition('.')[2], '__init__'):
            for line, text in _dates(path):
                msg = (
                    f'{target} cannot be reprocessed: it asks for {text} in {path.name}, line '
                    f'{line}: {CLOCK}'
                )
                raise ConfigurationError(msg)


def _dates(path: Path) -> Iterator[tuple[int, str]]:
    for node in ast.walk(ast.parse(path.read_bytes())):
        if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)):
            continue
        holder = node.func.value
        name = holder.attr if isinstance(holder, ast.Attribute) else getattr(holder, 'id', '')
        if node.func.attr in _NOW and name in _HOLDERS:
            yield node.lineno, f'{name}.{node.func.attr}()'
