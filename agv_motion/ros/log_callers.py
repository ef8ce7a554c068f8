"""The first line that a process logs, at a tenth of its cost.

For each line rclpy asks `inspect` for the file of whoever calls. The first time that resolves the
files of all modules there are: 0.05 s of a processor for 600 modules, 0.4 s for all of a robot's.
"""

from __future__ import annotations

import inspect
import sys

PACKAGES = ('agv_motion', 'rclpy')
"""whose functions stand between a node and its log"""
SEEN: set[str] = set()
"""Modules that were looked at: each node of a process looks at those that are new"""


def note_log_callers() -> None:
    """Tell `inspect` which modules our files are, as it would find out by looking at all files."""
    new = sys.modules.keys() - SEEN
    for name in new:
        file = getattr(sys.modules.get(name), '__file__', None)
        if file and name.partition('.')[0] in PACKAGES:
            inspect.modulesbyfile.setdefault(file, name)
    SEEN.update(new)
