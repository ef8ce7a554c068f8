"""The numbers of a room: its constants, and what is taken where nobody tells.

Few tests see them, since most results are right for others, too; so each room has a table of its
own in test_numbers.py, and who changes a number on purpose changes it there as well.
"""

from __future__ import annotations

import ast
import importlib
import inspect
from dataclasses import is_dataclass
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import ModuleType

PACKAGE = Path(__file__).parents[2] / 'agv_motion'


def constants(room: str) -> dict[str, Any]:
    """Return the numbers that the modules of a room name, by MODULE.NAME; also tuples of them."""
    found = {}
    for inside, module in _modules(room):
        for statement in ast.parse(Path(str(module.__file__)).read_text()).body:
            match statement:
                case ast.Assign(targets=targets):
                    parts = [part for target in targets for part in ast.walk(target)]
                case ast.AnnAssign(target=ast.Name() as target):
                    parts = [target]
                case _:
                    continue
            for name in (part.id for part in parts if isinstance(part, ast.Name)):
                if _is_number(getattr(module, name)):
                    found[f'{inside}.{name}'] = getattr(module, name)
    return found


def defaults(room: str, *, parameters: bool = True) -> dict[str, dict[str, Any]]:
    """Return the numbers but 0 and no that are taken where nobody tells, by MODULE.CALLED.

    Args:
        room: Its folder.
        parameters: Also those of classes of parameters, where no README has them in a table.

    """
    found = {}
    for name, called in _called(room, parameters=parameters):
        told = {
            parameter.name: parameter.default
            for parameter in inspect.signature(called).parameters.values()
            if _is_number(parameter.default) and parameter.default
        }
        if told:
            found[name] = told
    return found


def _is_number(value: Any) -> bool:
    if isinstance(value, tuple):
        return all(map(_is_number, value))
    return isinstance(value, (bool, int, float)) and not isinstance(value, Enum)


def _modules(room: str) -> Iterator[tuple[str, ModuleType]]:
    for path in sorted((PACKAGE / room).rglob('*.py')):
        inside = '.'.join(path.relative_to(PACKAGE / room).with_suffix('').parts)
        name = f'agv_motion.{room}.{inside}'.removesuffix('.__init__')
        yield inside, importlib.import_module(name)


def _called(room: str, *, parameters: bool) -> Iterator[tuple[str, Any]]:
    """Yield the name of each function and class of the room, and itself."""
    for inside, module in _modules(room):
        for name, one in vars(module).items():
            if getattr(one, '__module__', '') != module.__name__:
                continue
            if inspect.isfunction(one):
                yield f'{inside}.{name}', one
            elif inspect.isclass(one) and not issubclass(one, Enum):
                if parameters or not (is_dataclass(one) and name.endswith('Parameters')):
                    yield f'{inside}.{name}', one
                for inner, method in vars(one).items():
                    if inspect.isfunction(method) and inner != '__init__':
                        yield f'{inside}.{name}.{inner}', method
