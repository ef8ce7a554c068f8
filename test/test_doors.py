"""Every door: damaged and hostile inputs are used or refused; launch_scripts/fuzz_doors.py is long.

Here few inputs a door, so that each is opened; the numbers are seeded.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

sys.path.insert(0, str(Path(__file__).parents[1] / 'launch_scripts'))
import fuzz_doors

FILES, NODES, DATABASES = 150, 60, 8
"""inputs a door; for a database the disk is waited for"""


@pytest.mark.filterwarnings('ignore::RuntimeWarning')  # shapely, on what it then refuses
@pytest.mark.parametrize(
    'kind', ['file', 'database', 'text', 'line', 'messages', 'services', 'parameters']
)
def test_whatever_comes_is_used_or_refused(kind, capsys):
    inputs = NODES if kind in {'messages', 'services', 'parameters'} else FILES
    inputs = DATABASES if kind == 'database' else inputs
    assert fuzz_doors.main([str(inputs), '7', kind]) == 0, capsys.readouterr().out
