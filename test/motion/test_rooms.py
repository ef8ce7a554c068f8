"""The rooms of motion: each built on those before it, with a face, and each file with its test."""

from __future__ import annotations

import ast
import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MOTION = ROOT / 'agv_motion' / 'motion'
ORDER = ('command', 'navigation', 'navigation.reservations', 'behavior', 'pilot')
FILES = sorted(path for path in MOTION.rglob('*.py') if path.name != '__init__.py')


def name_of(path):
    return '.'.join(path.relative_to(ROOT).with_suffix('').parts)


def room_of(module):
    """Return the room of a module, by its place in the order."""
    inner = module.removeprefix('agv_motion.motion.')
    return max(i for i, room in enumerate(ORDER) if f'{inner}.'.startswith(f'{room}.'))


def imports(path):
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.module.startswith('agv_motion.motion.'):
            yield node.module


def test_a_room_imports_from_those_before_it_and_from_files_not_faces():
    for path in FILES:
        for module in imports(path):
            assert (MOTION / f'{"/".join(module.split(".")[2:])}.py').is_file(), f'{path}: {module}'
            assert room_of(module) <= room_of(name_of(path)), f'{path} imports {module}'


@pytest.mark.parametrize('room', ORDER[:-1])
def test_a_face_names_what_is_there_and_the_readme_tells_of_it(room):
    face = importlib.import_module(f'agv_motion.motion.{room}')
    readme = (MOTION / 'README.md').read_text()
    for name in face.__all__:
        assert hasattr(face, name)
        assert f'`{name}`' in readme, f'tell of {name} in motion/README.md'


def test_no_other_file_decides_by_the_name_of_a_strategy():
    for path in (ROOT / 'agv_motion').rglob('*.py'):
        if path.name != 'strategies.py':
            assert not re.search(r"""strategy (==|!=|in|is) ['"({\[]""", path.read_text()), path


def test_every_file_that_the_readme_names_is_there():
    for name in re.findall(r'`([\w/]+\.py)`', (MOTION / 'README.md').read_text()):
        places = (ROOT, ROOT / 'agv_motion', MOTION, *MOTION.glob('*/'), *MOTION.glob('*/*/'))
        tests = (ROOT / 'test' / 'motion').rglob(Path(name).name)
        assert any((place / name).is_file() for place in places) or any(tests), name
