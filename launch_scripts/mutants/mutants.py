"""The changes of a source file that a good test notices: where they are, and the changed code."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

SMALL = 1e-6
"""Numbers below it are rounding guards: twice as much is no change of behaviour."""
MANY = 1000
"""Whole numbers from here on are limits of size: one more is no change of behaviour."""

OPERATORS: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.Mod: ast.Mult, ast.Pow: ast.Mult, ast.FloorDiv: ast.Mult,
}  # fmt: skip
COMPARISONS: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.GtE, ast.GtE: ast.Lt, ast.Gt: ast.LtE, ast.LtE: ast.Gt, ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In,
}  # fmt: skip
"""The opposite: whether a limit itself belongs to a side seldom matters to a float."""
TURNS = ('pi', 'tau')
"""One more or one less is the same direction: they are multiplied by instead."""
NAMES = {
    'min': 'max', 'max': 'min', 'sin': 'cos', 'cos': 'sin', 'any': 'all', 'all': 'any',
    'floor': 'ceil', 'ceil': 'floor',
}  # fmt: skip
LEFT_ALONE = ('Spec', 'TypeVar', 'cast', 'field', 'warn', 'warning', 'info', 'error')
"""Calls whose arguments are texts and ranges."""
FLAGS = ('strict', 'fmt', 'end', 'key')
"""Arguments that tell Python how, not what."""


class Site(NamedTuple):
    """One change."""

    number: int
    """of the node, in the order of `_nodes`"""
    line: int
    what: str
    source: str
    """the line as it is"""


def sites(source: str) -> list[Site]:
    """Return every change of a file, in its order."""
    lines, tree = source.splitlines(), ast.parse(source)
    found = []
    for number, node in enumerate(_nodes(tree)):
        if what := _change(node, apply=False):
            line = node.lineno
            found.append(Site(number, line, what, lines[line - 1].strip()))
    return found


def mutated(source: str, site: Site) -> ast.Module:
    """Return the file with one change."""
    tree = ast.parse(source)
    for number, node in enumerate(_nodes(tree)):
        if number == site.number:
            _change(node, apply=True)
            break
    return ast.fix_missing_locations(tree)


def _nodes(node: ast.AST) -> Iterator[Any]:
    """Yield what may be changed: no annotations, docstrings, messages or checks for types."""
    for child in ast.iter_child_nodes(node):
        if _is_size(node):
            return
        if _is_left_alone(node, child):
            continue
        yield child
        yield from _nodes(child)


def _is_size(node: ast.AST) -> bool:
    """Return whether it is a size of memory or of a whole number, which makes nothing wrong."""
    match node:
        case ast.BinOp(op=ast.LShift()):
            return True
        case ast.BinOp(left=ast.Constant(value=2), op=ast.Pow(), right=ast.Constant()):
            return True
    return False


def _is_left_alone(parent: ast.AST, child: ast.AST) -> bool:
    names = [getattr(parent, name, None) for name in ('annotation', 'returns')]
    if any(child is each for each in (*names, *getattr(parent, 'decorator_list', ()))):
        return True
    match child:
        case ast.Raise() | ast.JoinedStr() | ast.Import() | ast.ImportFrom():
            return True
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)):
            return name in LEFT_ALONE
        case (
            ast.If(test=ast.Name(id='TYPE_CHECKING'))
            | ast.Assign(targets=[ast.Name(id='msg' | '__all__'), *_])
        ):
            return True
        case ast.keyword(arg=name):
            return name in FLAGS
    return False


def _change(node: Any, *, apply: bool) -> str:
    """Change a node in place, where that is asked for; return in words what changes, if it can."""
    for kind in (_operator, _sign, _comparison, _logic, _condition, _number, _name):
        if what := kind(node, apply=apply):
            return what
    return ''


def _operator(node: Any, *, apply: bool) -> str:
    if not isinstance(node, (ast.BinOp, ast.AugAssign)) or type(node.op) not in OPERATORS:
        return ''
    if _is_size(node):
        return ''
    if any(isinstance(part, (ast.JoinedStr, ast.List, ast.Tuple)) or _is_text(part)
           for part in ast.walk(node)):  # fmt: skip
        return ''  # of texts and lists, not of numbers
    before, after = type(node.op), OPERATORS[type(node.op)]
    if before in {ast.Add, ast.Sub} and any(map(_is_turn, ast.iter_child_nodes(node))):
        after = ast.Mult
    if apply:
        node.op = after()
    return f'{before.__name__} -> {after.__name__}'


def _sign(node: Any, *, apply: bool) -> str:
    if not isinstance(node, ast.UnaryOp) or not isinstance(node.op, (ast.USub, ast.Not)):
        return ''
    what = 'sign dropped' if isinstance(node.op, ast.USub) else 'not dropped'
    if apply:  # twice nothing keeps the value and needs no parent
        node.op = ast.UAdd() if isinstance(node.op, ast.USub) else ast.Not()
        if what == 'not dropped':
            node.operand = ast.UnaryOp(ast.Not(), node.operand)
    return what


def _comparison(node: Any, *, apply: bool) -> str:
    if not isinstance(node, ast.Compare) or type(node.ops[0]) not in COMPARISONS:
        return ''
    before, after = type(node.ops[0]), COMPARISONS[type(node.ops[0])]
    if apply:
        node.ops[0] = after()
    return f'{before.__name__} -> {after.__name__}'


def _logic(node: Any, *, apply: bool) -> str:
    if not isinstance(node, ast.BoolOp):
        return ''
    is_and = isinstance(node.op, ast.And)
    if apply:
        node.op = ast.Or() if is_and else ast.And()
    return 'and -> or' if is_and else 'or -> and'


def _condition(node: Any, *, apply: bool) -> str:
    if not isinstance(node, (ast.If, ast.IfExp)):
        return ''
    if not isinstance(node.test, (ast.Name, ast.Attribute, ast.Call)):
        return ''  # the others are changed by themselves
    if apply:
        node.test = ast.UnaryOp(ast.Not(), node.test)
    return 'condition turned round'


def _number(node: Any, *, apply: bool) -> str:
    if not isinstance(node, ast.Constant) or isinstance(node.value, (str, bytes)):
        return ''
    value = node.value
    if isinstance(value, bool):
        after: Any = not value
    elif isinstance(value, int):
        after = value + 1 if value < MANY else 2 * value
    elif isinstance(value, float) and not 0.0 < value < SMALL:
        after = 2.0 * value or 1.0
    else:
        return ''
    if apply:
        node.value = after
    return f'{value} -> {after}'


def _name(node: Any, *, apply: bool) -> str:
    if not isinstance(node, ast.Call) or getattr(node.func, 'id', '') not in NAMES:
        return ''
    before = node.func.id
    if apply:
        node.func.id = NAMES[before]
    return f'{before} -> {NAMES[before]}'


def _is_turn(node: ast.AST) -> bool:
    return (getattr(node, 'id', '') or getattr(node, 'attr', '')) in TURNS


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, (str, bytes))
