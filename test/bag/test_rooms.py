"""The rooms of bag: no circle of files, one way of imports, a face, one protocol of storages."""

from __future__ import annotations

import ast
import importlib
import pydoc
import re
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
BAG = ROOT / 'agv_motion' / 'bag'
FILES = sorted(path for path in BAG.rglob('*.py') if path.name != '__init__.py')
ABOVE = ('editing', 'checks', 'recording', 'playback')
"""Rooms that use the reader and the writer, which use none of them."""
ON_TOP = ('events', 'catalog')
"""Rooms that use those, too, and which nobody uses."""


def imports(path):
    """Yield the modules of the room that a file imports, those for type checking included."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and f'{node.module}.'.startswith('agv_motion.bag.'):
            for alias in node.names:
                inner = f'{node.module}.{alias.name}'
                is_file = (ROOT / f'{inner.replace(".", "/")}.py').is_file()
                yield inner if is_file else node.module


@cache
def all_imports():
    return [(path, module) for path in FILES for module in imports(path)]


def test_a_file_imports_files_and_not_faces():
    for path, module in all_imports():
        assert (ROOT / f'{module.replace(".", "/")}.py').is_file(), f'{path}: {module}'


def test_what_reads_and_writes_does_not_know_who_uses_it():
    for path, module in all_imports():
        mine = path.relative_to(BAG).parts[0]
        other = module.split('.')[2]
        assert other not in ABOVE or other == mine or mine in ON_TOP, f'{path} imports {module}'
        assert other not in ON_TOP or other == mine, f'{path} imports {module}'
        if mine in ('cdr', 'mcap', 'sqlite'):
            assert other not in ('reader', 'writer'), f'{path} imports {module}'


def test_only_who_opens_a_file_asks_for_its_format():
    for path in FILES:
        if path.parent.name not in ('mcap', 'sqlite') and path.name != 'reader.py':
            assert not re.search(r'\b(McapFile|SqliteFile)\b', path.read_text()), path


def test_the_face_is_a_manual_and_the_readme_tells_of_it():
    face = importlib.import_module('agv_motion.bag')
    manual = pydoc.plain(pydoc.render_doc(face))
    readme = (BAG / 'README.md').read_text()
    for name in face.__all__:
        assert getattr(face, name).__doc__
        assert name in manual
        assert f'`{name}`' in readme, f'tell of {name} in bag/README.md'


def test_every_file_that_the_readme_names_is_there():
    for name in re.findall(r'`([\w/]+\.py)`', (BAG / 'README.md').read_text()):
        assert any((place / name).is_file() for place in (BAG, ROOT)), name
