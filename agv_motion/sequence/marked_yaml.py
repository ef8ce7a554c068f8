"""YAML whose every value knows where it stands, so that an error can say file, line and column."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import yaml

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from pathlib import Path

KINDS = {float: 'a number', int: 'a whole number', bool: 'true or false', str: 'text'}


class Marked:
    """One value of a file."""

    def __init__(self, path: Path, node: yaml.Node, value: Any) -> None:
        """Keep ``value`` and where it stands."""
        self.path = path
        self.value = value
        self._node = node

    @classmethod
    def load(cls, path: Path) -> Marked:
        """Return the content of a file.

        Raises:
            ConfigurationError: It cannot be read, is no YAML, or is empty.

        """
        try:
            text = path.read_text(encoding='utf-8')
            node = yaml.compose(text, Loader=yaml.SafeLoader)
        except (OSError, UnicodeDecodeError) as error:
            msg = f"cannot read '{path}': {error}"
            raise ConfigurationError(msg) from error
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            where = _place(path, mark) if mark else path
            msg = f'{where}: no YAML: {error.problem or error.context}'
            raise ConfigurationError(msg) from error
        except yaml.YAMLError as error:
            msg = f'{path}: no YAML: {error}'
            raise ConfigurationError(msg) from error
        if node is None:
            msg = f'{path}: the file is empty'
            raise ConfigurationError(msg)
        return cls(path, node, _plain(node))

    @property
    def where(self) -> str:
        """File, line and column, counted from 1 as editors do."""
        mark = self._node.start_mark
        return _place(self.path, mark)

    def refuse(self, reason: str) -> NoReturn:
        """Raise a `ConfigurationError` that says where."""
        msg = f'{self.where}: {reason}'
        raise ConfigurationError(msg)

    def mapping(self, what: str) -> dict[str, tuple[Marked, Marked]]:
        """Return the keys of a mapping, each with itself and its value.

        Raises:
            ConfigurationError: It is no mapping, or a key stands twice.

        """
        if not isinstance(self._node, yaml.MappingNode):
            self.refuse(f'{what}: expected keys and values, got {self.value!r}')
        found: dict[str, tuple[Marked, Marked]] = {}
        for key_node, value_node in self._node.value:
            key = Marked(self.path, key_node, _plain(key_node))
            if str(key.value) in found:
                key.refuse(f"{what}: '{key.value}' stands twice")
            found[str(key.value)] = key, Marked(self.path, value_node, _plain(value_node))
        return found

    def items(self, what: str) -> list[Marked]:
        """Return the items of a list.

        Raises:
            ConfigurationError: It is no list.

        """
        if not isinstance(self._node, yaml.SequenceNode):
            self.refuse(f'{what}: expected a list, each item after a dash, got {self.value!r}')
        return [Marked(self.path, node, _plain(node)) for node in self._node.value]

    def typed(self, what: str, kind: type[Any]) -> Any:
        """Return the value as float, int, bool or str.

        Raises:
            ConfigurationError: It is of another type.

        """
        value = self.value
        if kind is float and isinstance(value, int) and not isinstance(value, bool):
            return float(value)
        if type(value) is not kind:
            self.refuse(f'{what} = {value!r}: expected {KINDS[kind]}')
        return value


def _place(path: Path, mark: yaml.Mark) -> str:
    return f'{path}, line {mark.line + 1}, column {mark.column + 1}'


def _plain(node: yaml.Node) -> Any:
    """Return what a node holds as plain Python."""
    return _Constructor().construct_document(node)


class _Constructor(yaml.constructor.SafeConstructor):
    """Makes Python of nodes that are composed already."""
