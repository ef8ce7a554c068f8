"""A season of bags."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / 'editing'))

import bags

DAY = 86400
MAY = 1_714_521_600
"""[s] 2024-05-01"""


@pytest.fixture
def season(tmp_path):
    """Return a folder of three bags on two days of May and one of June, and one that is torn."""
    folder = tmp_path / 'season'
    (folder / 'north').mkdir(parents=True)
    bags.write(folder / 'north' / 'a', start=MAY + 100)
    bags.write(folder / 'b', start=MAY + 200, topics=('/a', '/x'))
    bags.write(folder / 'c', start=MAY + 40 * DAY, count=4)
    shutil.copy(folder / 'c' / 'c_0.mcap', folder / 'loose.mcap')
    with (folder / 'loose.mcap').open('r+b') as file:
        file.truncate(file.seek(0, os.SEEK_END) // 3)
    (folder / '.hidden').mkdir()
    shutil.copy(folder / 'c' / 'c_0.mcap', folder / '.hidden' / 'h.mcap')
    return folder
