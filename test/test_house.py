"""One law of size for the whole package: how large, how deep, how many, and each with its test."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGE, TESTS = ROOT / 'agv_motion', ROOT / 'test'
LINES, FUNCTION = 300, 60
"""of a file and of a function, at most"""
ATTRIBUTES, MANY = 7, 0.05
"""of a class, at most, but for one class in twenty"""
DEEPEST = 9
"""Files in a chain of imports."""
MOST_IN_A_FACE, MOST_IN_FACES = 13, 100
"""Names of a room, and of all rooms together."""
UNTESTED = 0.25
"""Share of the modules, at most, whose test has another name than theirs; the aim is none."""
TESTED = ('files', 'kinematics', 'motion', 'route', 'trajectory')
"""Rooms in which each module has its test file; whoever brings another one so far adds it."""
DECLARES_ONLY = 5
"""Statements in functions up to which a module only declares: Protocols, values, constants."""

NOT_IN_3_10 = {
    'typing': {'Self', 'Never', 'LiteralString', 'Required', 'NotRequired', 'Unpack', 'override',
               'TypeVarTuple', 'assert_never', 'assert_type', 'reveal_type', 'dataclass_transform'},
    'enum': {'StrEnum', 'ReprEnum', 'verify', 'member', 'nonmember'},
    'datetime': {'UTC'},
    'asyncio': {'TaskGroup', 'Runner', 'timeout', 'timeout_at', 'Barrier'},
    'contextlib': {'chdir'},
    'itertools': {'batched'},
    'tomllib': {'load', 'loads'},
}  # fmt: skip
"""What later Pythons have that the oldest which this package is for has not, nor mypy misses."""


def files(folder):
    return sorted(folder.rglob('*.py'))


@cache
def tree(path):
    return ast.parse(path.read_text(encoding='utf-8'))


@cache
def nodes(path):
    return list(ast.walk(tree(path)))


@cache
def functions(path):
    return [n for n in nodes(path) if isinstance(n, (ast.FunctionDef, ast.AsyncFunctionDef))]


@cache
def statements(path):
    """Return how many statements stand in functions, their docstrings not counted."""
    return sum(
        not (isinstance(line, ast.Expr) and isinstance(line.value, ast.Constant))
        for function in functions(path)
        for line in function.body
    )


def name_of(path):
    return '.'.join(path.relative_to(ROOT).with_suffix('').parts).removesuffix('.__init__')


def test_no_file_and_no_function_is_too_long():
    """Look for the seam: what has a meaning of its own gets a place of its own."""
    found = {
        str(path.relative_to(ROOT)): lines
        for path in files(PACKAGE)
        if (lines := path.read_text(encoding='utf-8').count('\n')) > LINES
    }
    for path in files(PACKAGE):
        for node in functions(path):
            if (length := node.end_lineno - node.lineno + 1) > FUNCTION:
                found[f'{path.relative_to(ROOT)}, {node.name}'] = length
    assert found == {}


def test_what_is_imported_is_there_in_the_oldest_python():
    found = [
        f'{path.relative_to(ROOT)}: {node.module}.{name.name}'
        for path in [*files(PACKAGE), *files(ROOT / 'launch_scripts')]
        for node in nodes(path)
        if isinstance(node, ast.ImportFrom)
        for name in node.names
        if name.name in NOT_IN_3_10.get(node.module, ())
    ]
    assert found == []


def test_classes_with_many_attributes_are_few():
    """Attributes are what its methods assign to `self`."""
    classes, large = 0, []
    for path in files(PACKAGE):
        for node in nodes(path):
            if isinstance(node, ast.ClassDef):
                own = {
                    part.attr
                    for part in ast.walk(node)
                    if isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Store)
                    and isinstance(part.value, ast.Name) and part.value.id == 'self'
                }  # fmt: skip
                classes += 1
                large += [f'{len(own)} {node.name}'] * (len(own) > ATTRIBUTES)
    assert len(large) <= MANY * classes, sorted(large)


def needs(path, names):
    """Yield the modules of the package that a file imports when it is imported itself."""
    waiting = [tree(path)]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.ImportFrom) and node.module:
            inner = {f'{node.module}.{alias.name}' for alias in node.names} & names
            yield from inner or {node.module} & names
        elif not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and not (
            isinstance(node, ast.If) and ast.unparse(node.test) == 'TYPE_CHECKING'
        ):
            waiting += ast.iter_child_nodes(node)


def test_chains_of_imports_are_short():
    """From a file to the last that it needs at run time."""
    paths = {name_of(path): path for path in files(PACKAGE)}
    graph = {name: set(needs(path, paths.keys())) - {name} for name, path in paths.items()}

    @cache
    def chain(name):
        return (name, *max((chain(other) for other in graph[name]), key=len, default=()))

    longest = max(map(chain, graph), key=len)
    assert len(longest) <= DEEPEST, ' > '.join(longest)


def test_tests_are_more_than_half_as_long_as_the_code():
    code, tests = (
        sum(path.read_text(encoding='utf-8').count('\n') for path in files(folder))
        for folder in (PACKAGE, TESTS)
    )
    assert tests >= 0.6 * code, f'{tests} lines of tests for {code} of code'


HOLDERS = ('given', 'parameters', '_home', 'blocked')
"""Names under which parameters are at hand."""


def choices(path):
    """Yield the names of parameters that are one of several words."""
    for node in nodes(path):
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            words = [w.arg for part in ast.walk(node.annotation) if isinstance(part, ast.Call)
                     for w in part.keywords]  # fmt: skip
            if 'choices' in words:
                yield node.target.id


def test_no_decision_is_taken_on_a_text():
    """A parameter is one of several words to users; within, it is the member of an Enum."""
    names = {name for path in files(PACKAGE) for name in choices(path)}
    assert {'odom_covariance', 'clock', 'outside', 'when_full'} <= names
    found = []
    for path in files(PACKAGE):
        for node in nodes(path):
            match node:
                case ast.Compare(
                    left=ast.Attribute(value=holder, attr=name),
                    comparators=[ast.Constant(value=str())],
                ) if name in names and ast.unparse(holder).endswith(HOLDERS):
                    found.append(f'{path.relative_to(ROOT)}:{node.lineno}')
    assert found == []


def faced(path):
    """Return the names that a room's face exports."""
    for node in tree(path).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == '__all__':
            return ast.literal_eval(node.value)
    return []


@cache
def faced_names(room):
    return faced(ROOT.joinpath(*room.split('.'), '__init__.py'))


def test_faces_export_few_names():
    """What a user of the library needs; everything else may change."""
    faces = PACKAGE.rglob('__init__.py')
    found = {name_of(path): len(faced(path)) for path in faces if faced(path)}
    assert max(found.values()) <= MOST_IN_A_FACE, found
    assert sum(found.values()) <= MOST_IN_FACES, found


def test_rooms_import_each_other_by_the_module():
    """A face is for users: what our own rooms need beyond it stands in no `__init__`."""
    faces = {name_of(path) for path in PACKAGE.rglob('__init__.py') if faced(path)}
    found = [
        f'{path.relative_to(ROOT)}:{node.lineno}'
        for path in files(PACKAGE)
        for node in nodes(path)
        if isinstance(node, ast.ImportFrom)
        and node.module in faces
        and any(alias.name in faced_names(node.module) for alias in node.names)
    ]
    assert found == []


def is_judged(path):
    return path.name != '__init__.py' and statements(path) > DECLARES_ONLY


def untested():
    for path in files(PACKAGE):
        inside = path.relative_to(PACKAGE)
        mirrored = TESTS / inside.with_name(f'test_{inside.name}')
        if is_judged(path) and not mirrored.is_file():
            yield inside


def test_each_module_has_its_test_file():
    """Modules that only declare are excepted; of the other rooms a share must have it."""
    missing = list(untested())
    assert [str(path) for path in missing if path.parts[0] in TESTED] == []
    judged = [
        p for p in files(PACKAGE) if p.name != '__init__.py' and statements(p) > DECLARES_ONLY
    ]
    assert len(missing) <= UNTESTED * len(judged), sorted(map(str, missing))
