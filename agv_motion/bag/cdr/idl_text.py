"""Fields of message types that a bag defines in IDL (``ros2idl``).

rosbag2 writes the .idl file of a type and, each behind a line of 80 equals signs, those of the
types that it includes. Of the language is understood what describes data: modules, structs, enums,
typedefs and constants; annotations and comments are passed over.
Source: OMG IDL 4.2, section 7.4.1; https://design.ros2.org/articles/idl_interface_definition.html
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple, NoReturn

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Mapping

LONGEST_IDL = 1 << 20
"""Characters; the largest of ROS has a hundredth of it."""
_STRING = r'"(?:[^"\\\n]|\\.)*"'
_NOT_DATA = re.compile(
    rf'({_STRING})|//[^\n]*|/\*.*?\*/|^[ \t]*(?:={{3,}}|(?:IDL|MSG):|#)[^\n]*$',
    re.DOTALL | re.MULTILINE,
)
_TOKEN = re.compile(rf'\s*(L?{_STRING}|L?\'(?:[^\'\\]|\\.)*\'|::|<<|>>|[\w.]+|\S)')
_WORDS = {
    'boolean': 'bool', 'octet': 'byte', 'char': 'char', 'wchar': 'uint16', 'string': 'string',
    'wstring': 'wstring', 'float': 'float32', 'double': 'float64', 'short': 'int16',
    'long': 'int32', 'long long': 'int64', 'unsigned short': 'uint16', 'unsigned long': 'uint32',
    'unsigned long long': 'uint64',
    **{f'{sign}int{bits}': f'{sign}int{bits}' for sign in ('', 'u') for bits in (8, 16, 32, 64)},
}  # fmt: skip
_MODIFIERS = ('unsigned', 'long', 'short', 'double')
_ENUM = 'uint32'
_NESTED = 32
"""typedefs of typedefs"""


class _Type(NamedTuple):
    """A type as it is written in a scope."""

    name: str
    scope: str
    array: bool = False
    size: int | None = None


class _Text:
    """The tokens of a text, taken one after another."""

    def __init__(self, message_type: str, text: str) -> None:
        self._type = message_type
        self._tokens = _TOKEN.findall(_NOT_DATA.sub(lambda match: match[1] or ' ', text))
        self._at = 0

    @property
    def ended(self) -> bool:
        return self._at >= len(self._tokens)

    @property
    def next(self) -> str:
        return '' if self.ended else self._tokens[self._at]

    def take(self, *expected: str) -> str:
        """Return the next token, which must be one of ``expected`` if there are any."""
        token = self.next
        if not token or (expected and token not in expected):
            self.refuse(f'{token!r:.40}, expected {" or ".join(expected) or "more"}')
        self._at += 1
        return token

    def word(self) -> str:
        """Return a name."""
        if not re.fullmatch(r'[A-Za-z]\w*', self.next):
            self.refuse(f'{self.next!r:.40}, expected a name')
        return self.take()

    def path(self) -> str:
        """Return a name with its scopes, as PACKAGE/msg/NAME."""
        parts = ['']
        if self.next != '::':
            parts = [self.word()]
        while self.next == '::':
            self.take()
            parts.append(self.word())
        return '/'.join(parts)

    def skip_to(self, *ends: str) -> str:
        """Pass over tokens, brackets with all in them, up to one of ``ends``; return what was."""
        passed, depth = [], 0
        while self.next and (depth or self.next not in ends):
            depth += (self.next in '([{') - (self.next in ')]}')
            passed.append(self.take())
        return ' '.join(passed)

    def annotations(self) -> None:
        """Pass over annotations, such as ``@verbatim (language="comment", text="...")``."""
        while self.next == '@':
            self.take()
            self.path()
            if self.next == '(':
                self.take()
                self.skip_to(')')
                self.take(')')

    def refuse(self, finding: str) -> NoReturn:
        before = ' '.join(self._tokens[max(self._at - 3, 0) : self._at])
        _refuse(self._type, f'after {before!r:.60} stands {finding}')


def _refuse(message_type: str, finding: str) -> NoReturn:
    msg = f'definition of {message_type}: its IDL cannot be understood ({finding})'
    raise ConfigurationError(msg)


def fields_from_idl(
    message_type: str, text: str
) -> dict[str, list[tuple[str, str, bool, int | None]]]:
    """Return name, type, whether it is an array, and its fixed size, of each field of each type.

    Raises:
        ConfigurationError: The text cannot be understood.

    """
    if len(text) > LONGEST_IDL:
        msg = f'definition of {message_type}: {len(text)} characters of IDL, at most {LONGEST_IDL}'
        raise ConfigurationError(msg)
    found = _Declarations(message_type, text)
    return {
        name: [(field, *found.resolved(kind)) for field, kind in fields]
        for name, fields in found.structs.items()
    }


class _Declarations:
    """What a text declares, by full name."""

    def __init__(self, message_type: str, text: str) -> None:
        self._type, self._text = message_type, _Text(message_type, text)
        self.structs: dict[str, list[tuple[str, _Type]]] = {}
        self._typedefs: dict[str, _Type] = {}
        self._constants: dict[str, int] = {}
        while not self._text.ended:
            self._declaration('')

    def resolved(self, kind: _Type) -> tuple[str, bool, int | None]:
        """Return a type without typedefs: its name, whether it is an array, and its size."""
        array, size = kind.array, kind.size
        for _ in range(_NESTED):
            name = self._find(kind, {**self.structs, **self._typedefs})
            if name not in self._typedefs:
                return name, array, size
            kind = self._typedefs[name]
            if array and kind.array:
                if size is None or kind.size is None:
                    _refuse(self._type, f'{name} is an array in an array')
                size *= kind.size
            elif kind.array:
                array, size = True, kind.size
        _refuse(self._type, 'typedefs of typedefs without end')

    def _find(self, kind: _Type, known: Mapping[str, object]) -> str:
        """Return the full name of a type, sought from the scope where it stands outwards."""
        if kind.name.startswith('/'):
            return kind.name[1:]
        scope = kind.scope
        while scope:
            if f'{scope}/{kind.name}' in known:
                return f'{scope}/{kind.name}'
            scope = scope.rpartition('/')[0]
        return kind.name

    def _declaration(self, scope: str) -> None:
        text = self._text
        text.annotations()
        what = text.take('module', 'struct', 'enum', 'typedef', 'const', ';')
        if what == 'module':
            inner = _inside(scope, text.word())
            text.take('{')
            while text.next != '}':
                self._declaration(inner)
            text.take('}')
        elif what == 'struct':
            self._struct(_inside(scope, text.word()))
        elif what == 'enum':
            self._typedefs[_inside(scope, text.word())] = _Type(_ENUM, '')
            text.take('{')
            text.skip_to('}')
            text.take('}')
        elif what == 'typedef':
            for name, kind in self._members(scope):
                self._typedefs[_inside(scope, name)] = kind
        elif what == 'const':
            self._constant(scope)

    def _constant(self, scope: str) -> None:
        self._kind(scope)
        name = _inside(scope, self._text.word())
        self._text.take('=')
        value = self._text.skip_to(';')
        if value.isdecimal():
            self._constants[name] = int(value)

    def _struct(self, name: str) -> None:
        text = self._text
        fields = self.structs.setdefault(name, [])
        fields.clear()  # told again by another file that includes it
        if text.next == ':':
            text.take()
            base = self._find(_Type(text.path(), name.rpartition('/')[0]), self.structs)
            fields += self.structs.get(base, ())
        if text.next == ';':
            return  # declared only
        text.take('{')
        while text.next != '}':
            fields += self._members(name)
            text.take(';')
        text.take('}')

    def _members(self, scope: str) -> list[tuple[str, _Type]]:
        """Return the names declared with one type, and the type of each."""
        text, members = self._text, []
        text.annotations()
        kind = self._kind(scope)
        while True:
            name, this = text.word(), kind
            while text.next == '[':
                text.take()
                size = self._number(scope)
                text.take(']')
                if this.array and this.size is None:
                    text.refuse('an array of sequences')
                this = this._replace(array=True, size=size * (this.size or 1))
            members.append((name, this))
            if text.next != ',':
                return members
            text.take()

    def _kind(self, scope: str) -> _Type:
        text = self._text
        text.annotations()
        if text.next == 'sequence':
            text.take()
            text.take('<')
            inner = self._kind(scope)
            if inner.array:
                text.refuse('a sequence of sequences')
            self._bound(scope)
            return inner._replace(array=True, size=None)
        name = text.path()
        while name.rpartition(' ')[2] in _MODIFIERS and text.next in _MODIFIERS:
            name = f'{name} {text.take()}'
        if name in ('string', 'wstring') and text.next == '<':
            text.take()
            self._bound(scope)
        if name.split()[0] in _MODIFIERS and name not in _WORDS:
            text.refuse(f'{name}, which CDR of ROS does not know')
        return _Type(_WORDS[name], '') if name in _WORDS else _Type(name, scope)

    def _bound(self, scope: str) -> None:
        """Pass over the end of a sequence or string, with its bound."""
        if self._text.next == ',':
            self._text.take()
        if self._text.next != '>':
            self._number(scope)
        self._text.take('>')

    def _number(self, scope: str) -> int:
        text = self._text
        if text.next.isdecimal():
            return int(text.take()[:18])
        name = self._find(_Type(text.path(), scope), self._constants)
        if name not in self._constants:
            _refuse(self._type, f'{name} is no number')
        return self._constants[name]


def _inside(scope: str, name: str) -> str:
    return f'{scope}/{name}' if scope else name
