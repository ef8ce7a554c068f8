"""Definitions of installed message types, as a bag keeps them: full text and type hash.

Interface packages install ``share/PACKAGE/msg/NAME.msg`` and, since Iron, ``NAME.json`` with the
hash of the type (REP-2011). They are found where the ament index looks, and in the running
environment, where the wheels of ROS put them.
"""

from __future__ import annotations

import os
import re
import sys
from functools import cache
from pathlib import Path
from typing import NamedTuple

from agv_motion.bag.cdr.interface_parts import SECTIONS, SEPARATOR, base, following, sections
from agv_motion.errors import ConfigurationError
from agv_motion.files import json_text

PRIMITIVES = {
    *('bool', 'byte', 'char', 'float32', 'float64', 'string', 'wstring'),
    *('int8', 'uint8', 'int16', 'uint16', 'int32', 'uint32', 'int64', 'uint64'),
}
WITHOUT_PACKAGE = {
    'tf2_msgs/TFMessage': (
        'geometry_msgs/TransformStamped[] transforms\n',
        'RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087',
    ),
}
"""Types that are written though their package has no wheel: text and hash, as Jazzy has them."""
_FIELD_TYPE = re.compile(r'[ \t]*([A-Za-z][\w/]*)(?:<=\d+)?(?:\[[^\]]*\])?[ \t]+[A-Za-z]')
_HEADER_FIRST = re.compile(r'(?:[ \t]*(?:#.*)?\n)*[ \t]*std_msgs/(?:msg/)?Header[ \t]+header\b')
_TYPE_NAME = re.compile(r'([A-Za-z]\w*)/(?:(?:msg|srv|action)/)?([A-Za-z]\w*)')


class Definition(NamedTuple):
    """A message type as a bag keeps it."""

    text: str
    """the .msg file, then that of every type it uses, each after a line of 80 equals signs"""
    hash: str
    """``RIHS01_...``, or '' where it is not installed"""


def begins_with_header(text: str) -> bool:
    """Return whether a definition (ros2msg) begins with a header."""
    return _HEADER_FIRST.match(text) is not None


def search_path() -> list[Path]:
    """Return the prefixes in which packages may be installed, first come first served."""
    prefixes = os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep)
    return [Path(prefix) for prefix in [*prefixes, sys.prefix] if prefix]


@cache
def installed(message_type: str) -> Definition:
    """Return the definition of ``message_type``, such as ``geometry_msgs/msg/Twist``.

    Raises:
        ConfigurationError: The name is malformed, or the type or one it uses is not installed.

    """
    texts: dict[str, str] = {}
    waiting = [message_type]
    while waiting:
        wanted = waiting.pop()
        package, name = split(wanted)
        short = f'{package}/{name}'
        if short not in texts:
            texts[short] = _text(package, name, for_type=message_type)
            waiting.extend(reversed(dependencies(texts[short], package)))
    (_, full), *used = texts.items()
    parts = [full, *(f'{SEPARATOR}\nMSG: {name}\n{text}' for name, text in used)]
    return Definition('\n'.join(parts), _hash(message_type))


def split(message_type: str) -> tuple[str, str]:
    """Return package and name of a type.

    Raises:
        ConfigurationError: ``message_type`` is not of the form PACKAGE/msg/NAME.

    """
    match = _TYPE_NAME.fullmatch(message_type)
    if not match:
        msg = f'message type {message_type!r}: expected PACKAGE/msg/NAME, as std_msgs/msg/String'
        raise ConfigurationError(msg)
    return match[1], match[2]


def dependencies(text: str, package: str) -> list[str]:
    """Return the types that a .msg file uses, as PACKAGE/NAME, in the order of their use."""
    matches = (_FIELD_TYPE.match(line) for line in text.splitlines())
    names = dict.fromkeys(match[1] for match in matches if match and match[1] not in PRIMITIVES)
    return [name if '/' in name else f'{package}/{name}' for name in names]


def _text(package: str, name: str, *, for_type: str) -> str:
    """Return the .msg file of a type, or what stands for one of a service or an action."""
    full, owner = f'{package}/{name}', base(name)
    for folder, file in (('msg', name), *((folder, owner) for folder in SECTIONS)):
        path = interface_file(package, folder, f'{file}.{folder}')
        if path is None:
            continue
        text = path.read_text(encoding='utf-8')
        if folder == 'msg':
            return text
        parts = dict(sections(f'{package}/{owner}', text.splitlines()))
        lines = parts[full] if full in parts else following(full).splitlines()
        return '\n'.join([*lines, ''])
    if full in WITHOUT_PACKAGE:
        return WITHOUT_PACKAGE[full][0]
    prefixes = ', '.join(map(str, search_path()))
    msg = (
        f'no {package}/msg/{name}.msg (for {for_type}) under {prefixes}: install {package}, or '
        'source the workspace that has it'
    )
    raise ConfigurationError(msg)


def interface_file(package: str, folder: str, file: str) -> Path | None:
    """Return the file of an interface, such as ``std_msgs``, ``msg``, ``String.msg``."""
    paths = (prefix / 'share' / package / folder / file for prefix in search_path())
    return next((path for path in paths if path.is_file()), None)


def _hash(message_type: str) -> str:
    package, name = split(message_type)
    folders = (('msg', name), *((folder, base(name)) for folder in SECTIONS))
    found = (interface_file(package, folder, f'{file}.json') for folder, file in folders)
    path = next(filter(None, found), None)
    if path is None and f'{package}/{name}' in WITHOUT_PACKAGE:
        return WITHOUT_PACKAGE[f'{package}/{name}'][1]
    if path is None:
        return ''  # older distributions install no hash; rosbag2 writes '' as well
    try:
        hashes = json_text.load(path).value['type_hashes']
        return next(
            str(entry['hash_string'])
            for entry in hashes
            if entry['type_name'] == f'{package}/{path.parent.name}/{name}'
        )
    except (ConfigurationError, ValueError, KeyError, TypeError, StopIteration):
        return ''
