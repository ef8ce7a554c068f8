"""Every door: damaged and hostile inputs are used or refused.

Here few inputs a door, so that each is opened; the numbers are seeded. The long form is
launch_scripts/fuzz/fuzz_doors.py.
"""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

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
