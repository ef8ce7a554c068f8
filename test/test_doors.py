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

FILES, NODES = 150, 60
"""inputs a door"""


@pytest.mark.filterwarnings('ignore::RuntimeWarning')  # shapely, on what it then refuses
@pytest.mark.parametrize('kind', ['file', 'text', 'line', 'messages', 'services', 'parameters'])
def test_whatever_comes_is_used_or_refused(kind, capsys):
    inputs = NODES if kind in {'messages', 'services', 'parameters'} else FILES
    assert fuzz_doors.main([str(inputs), '7', kind]) == 0, capsys.readouterr().out
