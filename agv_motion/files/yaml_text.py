"""YAML, event by event: no depth, alias, tag or number of a file can hang or end the program.

Plain scalars mean what they mean to PyYAML, with three exceptions: dates stay text, ``1e3`` is a
number (as it is for ROS), and ``<<`` merges nothing.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import yaml

from agv_motion.errors import ConfigurationError
from agv_motion.files import text as files
from agv_motion.files.limits import DEPTH, NUMBER, VALUES
from agv_motion.files.marked import Marked, quoted

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

_LOADER = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)
_DUMPER = getattr(yaml, 'CSafeDumper', yaml.SafeDumper)
"""four times as fast where PyYAML was built with libyaml: it counts as a bag is closed"""
_TAGS = {f'tag:yaml.org,2002:{name}': name for name in ('str', 'int', 'float', 'bool', 'null')}
_FLOAT = re.compile(r'[-+]?(\d+(\.\d*)?|\.\d+)[eE][-+]?\d+\Z', re.ASCII)
_UNPRINTABLE = re.compile('[^\t\n\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]')
_CONSTRUCTOR = yaml.constructor.SafeConstructor()


def load(path: Path, what: str = 'the file') -> Marked:
    """Return the content of a file.

    Raises:
        ConfigurationError: It cannot be read, is no YAML, is empty, or goes beyond the limits.

    """
    content = parse(files.read(path, what), path)
    if content is None:
        msg = f'{path}: the file is empty'
        raise ConfigurationError(msg)
    return content


def plain(text: str, path: Path | str, values: int = VALUES) -> Any:
    """Return what a text of so many values at most says as plain objects, None of an empty one.

    Raises:
        ConfigurationError: It is no YAML, or goes beyond the limits.

    """
    content = parse(text, path, values)
    return None if content is None else content.value


def parse(text: str, path: Path | str, values: int = VALUES) -> Marked | None:
    """Return what a text says, None of an empty one.

    Args:
        text: YAML.
        path: Where it is from, for the errors.
        values: How many it may hold.

    Raises:
        ConfigurationError: It is no YAML, or goes beyond the limits.

    """
    wrong = _UNPRINTABLE.search(text)
    if wrong:
        before = text[: wrong.start()].split('\n')
        where = path, len(before), len(before[-1]) + 1
        reason = f'no YAML: a control character (0x{ord(wrong[0]):02x})'
        raise ConfigurationError.at(where, reason, reason)
    try:
        return _Tree(path, values).built(yaml.parse(text, Loader=_LOADER))
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line, column = (mark.line, mark.column) if mark else (0, 0)
        reason = f'no YAML: {error.problem or error.context}'
        if (
            text.split('\n')[line : line + 1]
            and text.split('\n')[line][column : column + 1] == '\t'
        ):
            reason = 'no YAML: a tab stands here; indent by blanks'
        raise ConfigurationError.at((path, line + 1, column + 1), reason, 'no YAML') from error


def dump(content: Any) -> str:
    """Return plain mappings and lists, strings and numbers as YAML, their entries in order."""
    text: str = yaml.dump(content, Dumper=_DUMPER, sort_keys=False)
    return text


class _Open:
    """A mapping or list whose end has not come."""

    def __init__(self, mark: Any, anchor: str | None, *, mapping: bool) -> None:
        self.mark, self.anchor = mark, anchor
        self.entries: dict[str, tuple[Marked, Marked]] | None = {} if mapping else None
        self.items: list[Marked] = []
        self.key: Marked | None = None

    def add(self, node: Marked) -> None:
        if self.entries is None:
            self.items.append(node)
        elif self.key is None:
            if isinstance(node.value, (dict, list)):
                node.refuse('a mapping or list cannot be a key', 'a mapping or list as a key')
            if str(node.value) in self.entries:
                node.refuse(f"'{node.value!s:.80}' stands twice", 'a key that stands twice')
            self.key = node
        else:
            self.entries[str(self.key.value)] = self.key, node
            self.key = None


class _Tree:
    """Builds values of events; without recursion, whatever their depth."""

    def __init__(self, path: Path | str, values: int) -> None:
        self._path, self._values = path, values
        self._open: list[_Open] = []
        self._named: dict[str, Marked] = {}
        self._root: Marked | None = None
        self._count = 0
        self._too_many = f'more than {values} values up to here, repeated ones included'

    def built(self, events: Iterable[yaml.Event]) -> Marked | None:
        """Return the one document of a file."""
        for event in events:
            if isinstance(event, yaml.ScalarEvent):
                self._add(event.anchor, self._scalar(event))
            elif isinstance(event, (yaml.MappingStartEvent, yaml.SequenceStartEvent)):
                self._begin(event)
            elif isinstance(event, (yaml.MappingEndEvent, yaml.SequenceEndEvent)):
                done = self._open.pop()
                items = done.items if done.entries is None else None
                self._add(done.anchor, self._marked(done.mark, None, done.entries, items))
            elif isinstance(event, yaml.AliasEvent):
                self._repeat(event)
            elif isinstance(event, yaml.DocumentStartEvent) and self._root is not None:
                self._refuse(event.start_mark, 'a second document begins: give one')
        return self._root

    def _begin(self, event: Any) -> None:
        if len(self._open) == DEPTH:
            self._refuse(event.start_mark, f'nested more than {DEPTH} deep')
        if event.tag not in {None, '!', 'tag:yaml.org,2002:map', 'tag:yaml.org,2002:seq'}:
            self._refuse(event.start_mark, 'a tag that is not known here')
        mapping = isinstance(event, yaml.MappingStartEvent)
        self._open.append(_Open(event.start_mark, event.anchor, mapping=mapping))

    def _repeat(self, event: Any) -> None:
        if event.anchor not in self._named:
            self._refuse(event.start_mark, 'an alias of nothing that came before')
        repeated = self._named[event.anchor]
        self._count += repeated.size
        if self._count > self._values:
            self._refuse(event.start_mark, self._too_many)
        self._place(repeated)

    def _add(self, anchor: str | None, node: Marked) -> None:
        self._count += 1
        if self._count > self._values:
            node.refuse(self._too_many, self._too_many)
        if anchor:
            self._named[anchor] = node
        self._place(node)

    def _place(self, node: Marked) -> None:
        if self._open:
            self._open[-1].add(node)
        else:
            self._root = node

    def _scalar(self, event: Any) -> Marked:
        value = event.value
        tag = event.tag
        if tag not in {None, '!'}:
            name = _TAGS.get(tag, '')
            if not name:
                self._refuse(event.start_mark, 'a tag that is not known here')
        else:
            name = _meaning(value) if event.implicit[0] and tag is None else 'str'
        mark = event.start_mark
        if name in {'int', 'float'} and len(value) > NUMBER:
            self._refuse(mark, f'a number of {len(value)} characters: {NUMBER} are enough')
        try:
            return self._marked(mark, _made(name, value))
        except (ValueError, KeyError, OverflowError, IndexError):
            words = {
                'int': 'no whole number',
                'float': 'no number',
                'bool': 'neither true nor false',
            }
            node = self._marked(mark, value)
            node.refuse(f'{quoted(value)} is {words[name]}', words[name])

    def _marked(
        self,
        mark: Any,
        value: Any,
        entries: dict[str, tuple[Marked, Marked]] | None = None,
        items: list[Marked] | None = None,
    ) -> Marked:
        return Marked(self._path, mark.line + 1, mark.column + 1, value, entries, items)

    def _refuse(self, mark: Any, reason: str) -> None:
        self._marked(mark, None).refuse(reason, reason)


def _meaning(value: str) -> str:
    """Return the name of the type that a plain scalar means."""
    for tag, pattern in yaml.SafeLoader.yaml_implicit_resolvers.get(value[:1], ()):
        if pattern.match(value):
            return _TAGS.get(tag, 'str')
    return 'float' if _FLOAT.match(value) else 'str'


def _made(name: str, value: str) -> Any:
    if name == 'str':
        return value
    if name == 'null':
        return None
    if name == 'bool':
        return _CONSTRUCTOR.bool_values[value.lower()]
    node = yaml.ScalarNode(f'tag:yaml.org,2002:{name}', value)
    make = _CONSTRUCTOR.construct_yaml_int if name == 'int' else _CONSTRUCTOR.construct_yaml_float
    return make(node)
