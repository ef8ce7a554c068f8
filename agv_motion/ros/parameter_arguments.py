"""What the command line says of parameters, looked at before rcl does.

A fault in a parameter file ends rcl with a trace of C code, and a file or an argument for a node
of another name is passed over without a word.
"""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from agv_motion.errors import ConfigurationError
from agv_motion.files import yaml_text
from agv_motion.files.text import read
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

VALUES = 'ros__parameters'
SINGLE = '-p', '--param'
FILE = ('--params-file',)


def check_arguments(arguments: Sequence[str]) -> None:
    """Read every parameter and parameter file of a command line.

    Raises:
        ConfigurationError: One is no ``name:=value``; or a file cannot be read, is no YAML, or
            holds a value outside of any node.

    """
    for rule in _given(arguments, *SINGLE):
        name, _, value = rule.partition(':=')
        if not name or not value:
            msg = f"-p '{rule}': write -p name:=value"
            raise ConfigurationError(msg)
    for path in _given(arguments, *FILE):
        sections(path)


def passed_over(arguments: Sequence[str], node: str) -> Iterator[str]:
    """Yield what of a command line has nothing for ``node``, a name with its namespace."""
    for path in _given(arguments, *FILE):
        keys = [key for key, _ in sections(path)]
        if keys and not any(is_for(key, node) for key in keys):
            yield (
                f"parameter file '{path}' has nothing for {node}: it is for "
                f'{", ".join(keys)}{meant(node, keys)}'
            )
    for rule in _given(arguments, *SINGLE):
        key, found, _ = rule.partition(':=')[0].partition(':')
        if found and not is_for(key, node):
            yield f"-p {rule} is for the node '{key}', this one is {node}{meant(node, ['/' + key])}"


def overruled(arguments: Sequence[str], node: str) -> Iterator[str]:
    """Yield what ``-p name:=value`` asks of ``node`` in vain, since a file counts for more.

    ROS takes it for a value of ``/**``. Of the names in files that fit a node, the one that
    appeared last counts, and one that is given again stays where it appeared first.
    """
    names: dict[str, dict[str, str]] = {}
    asked: dict[str, str] = {}
    for option, value in _options(arguments):
        if option in FILE:
            for key, values in sections(value):
                names.setdefault(key, {}).update(dict.fromkeys(_dotted(values), value))
        elif option in SINGLE and ':' not in value.partition(':=')[0]:
            names.setdefault('/**', {})
            asked[value.partition(':=')[0]] = value
    for name, rule in asked.items():
        *_, last = ('/**', *(key for key in names if is_for(key, node) and name in names[key]))
        later = list(names).index(last) > list(names).index('/**')
        if later:
            yield (
                f"-p {rule} counts for nothing: '{names[last][name]}' says {name} for {last}; "
                'change it there, or give a parameter file of your own after that one'
            )


def _dotted(values: dict[str, Any], prefix: str = '') -> Iterator[str]:
    for name, value in values.items():
        if isinstance(value, dict):
            yield from _dotted(value, f'{prefix}{name}.')
        else:
            yield f'{prefix}{name}'


def _given(arguments: Sequence[str], *options: str) -> Iterator[str]:
    """Yield the values of an option of ROS."""
    return (value for option, value in _options(arguments) if option in options)


def _options(arguments: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield each word among the arguments of ROS with the one after it."""
    ours = False
    for option, value in pairwise(arguments):
        if option in {'--ros-args', '--'}:
            ours = option == '--ros-args'
        elif ours:
            yield option, value


def _content(path: str) -> Any:
    content = yaml_text.parse(read(Path(path), 'the parameter file'), path)
    return {} if content is None else content.value


def sections(path: Path | str) -> list[tuple[str, dict[str, Any]]]:
    """Return what a parameter file says: full names of nodes, and their parameters.

    Names may be nested, and hold ``*`` for a word and ``**`` for any namespace. Of what several
    sections give to a node, the last one counts, as for ROS.

    Raises:
        ConfigurationError: It cannot be read, is no YAML, or holds a value outside of any node.

    """
    return list(_sections(str(path), _content(str(path)), ''))


def _sections(path: str, content: Any, prefix: str) -> Iterator[tuple[str, dict[str, Any]]]:
    if not isinstance(content, dict):
        where = f"'{prefix}' = {content!r} stands" if prefix else f'{content!r} stands'
        msg = (
            f'{path}: {where} outside of the parameters of any node; write, indented: '
            f'name_of_the_node: {VALUES}: name: value'
        )
        raise ConfigurationError(msg)
    for name, value in content.items():
        if name != VALUES:
            yield from _sections(path, value, f'{prefix}/{str(name).strip("/")}')
        elif not prefix:
            msg = f'{path}: {VALUES} stands at the top: write it below the name of a node, or /**'
            raise ConfigurationError(msg)
        else:
            yield prefix, value if isinstance(value, dict) else {}


def is_for(key: str, node: str) -> bool:
    """Return whether a name, where ``/**`` is any namespace and ``/*`` one word, is of a node."""
    pattern = re.escape('/' + key.strip('/'))
    pattern = pattern.replace(r'/\*\*', '(/[^/]+)*').replace(r'\*', '[^/]+')
    return re.fullmatch(pattern, node) is not None
