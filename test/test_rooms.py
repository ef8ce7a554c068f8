"""Rooms around the core: each file is told in the page of its room, and so is each public name."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1] / 'agv_motion'
ROOMS = ('report', 'reprocess', 'demo', 'cli')
FACES = ('report', 'reprocess')


@pytest.mark.parametrize('room', ROOMS)
def test_the_page_of_a_room_tells_of_every_file_and_folder(room):
    page = (ROOT / room / 'README.md').read_text(encoding='utf-8')
    files = [path.name for path in (ROOT / room).glob('*.py') if path.name != '__init__.py']
    folders = [f'{path.parent.name}/' for path in (ROOT / room).glob('*/__init__.py')]
    missing = [name for name in files + folders if f'`{name}' not in page]
    assert missing == [], f'tell of them in {room}/README.md'


@pytest.mark.parametrize('room', FACES)
def test_a_face_names_what_is_there_and_the_page_tells_of_it(room):
    pytest.importorskip('rclpy')
    face = importlib.import_module(f'agv_motion.{room}')
    page = (ROOT / room / 'README.md').read_text(encoding='utf-8')
    for name in face.__all__:
        assert hasattr(face, name)
        assert f'`{name}`' in page, f'tell of {name} in {room}/README.md'


def test_matplotlib_is_imported_in_the_report_only():
    found = {
        path.relative_to(ROOT).parts[0]
        for path in ROOT.rglob('*.py')
        if 'import matplotlib' in (text := path.read_text('utf-8')) or 'from matplotlib' in text
    }
    assert found == {'report'}
