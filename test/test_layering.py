"""The laws of the house: the core knows no ROS, and imports run one way."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1] / 'agv_motion'
CORE = (
    'probe', 'motion', 'kinematics', 'odometry', 'trajectory', 'route', 'sequence', 'simulation',
    'bag', 'files', 'arbitration', 'explanation', 'model',
)  # fmt: skip
ROS = ('rclpy', 'rcl_interfaces', 'lifecycle_msgs', '_msgs', 'ament', 'std_srvs')
LAYERS = {
    'errors': 0, 'planar': 1, 'parameters': 1, 'saved_state': 1, 'watchdog': 1,
    'clock_watch': 1, 'activity': 1, 'sun': 1, 'visible': 1, 'twist_limits': 2, 'blocked': 2,
    'files': 1, 'arbitration': 2,
    'kinematics': 2, 'probe': 2, 'odometry': 3, 'trajectory': 3, 'route': 3, 'motion': 3,
    'model': 3, 'sequence': 4, 'simulation': 4, 'explanation': 4,
    'bag': 4, 'dashboard': 5, 'ros': 5, 'report': 6, 'client': 6, 'nodes': 7,
    'reprocess': 8, 'demo': 8, 'cli': 9,
}  # fmt: skip
"""A module imports from its own folder or from a lower number."""


@cache
def parsed(path):
    """Return the syntax of a file: its top, and all its imports."""
    tree = ast.parse(path.read_text())
    return tree.body, [n for n in ast.walk(tree) if isinstance(n, ast.Import | ast.ImportFrom)]


def imports(path):
    """Return the modules that a file imports, those for type checking included."""
    for node in parsed(path)[1]:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        else:
            assert node.level == 0, f'{path}: relative import'
            yield node.module


def files(*folders):
    return [path for folder in folders for path in sorted((ROOT / folder).rglob('*.py'))]


@pytest.mark.parametrize('folder', CORE)
def test_the_core_imports_no_ros(folder):
    for path in files(folder):
        for module in imports(path):
            assert not any(name in module.split('.')[0] for name in ROS), f'{path}: {module}'


def test_imports_run_from_the_nodes_down_to_planar():
    for path in files('.'):
        parts = path.relative_to(ROOT).with_suffix('').parts
        if parts[0] == '__init__':
            continue
        for module in imports(path):
            target = module.split('.')
            if target[0] != 'agv_motion' or target[1:2] in ([], [parts[0]]):
                continue
            assert LAYERS[target[1]] < LAYERS[parts[0]], f'{path} imports {module}'


def test_no_circle_of_files():
    """Imports for type checking count, too."""
    package = ROOT.parent
    names = {'.'.join(p.relative_to(package).with_suffix('').parts): p for p in files('.')}
    needs = {name: set(imports(path)) & names.keys() for name, path in names.items()}
    while needs:
        done = [name for name, others in needs.items() if not others & needs.keys()]
        assert done, f'in a circle, or led to by one: {sorted(needs)}'
        for name in done:
            del needs[name]


def test_one_public_class_name_is_one_class():
    where = {}
    for path in files('.'):
        for node in parsed(path)[0]:
            if isinstance(node, ast.ClassDef) and not node.name.startswith('_'):
                where.setdefault(node.name, []).append(str(path.relative_to(ROOT)))
    assert {name: paths for name, paths in where.items() if len(paths) > 1} == {}
