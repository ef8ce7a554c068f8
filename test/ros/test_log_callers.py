"""The first line of a process in its log."""

from __future__ import annotations

import inspect
import sys
from types import ModuleType

import pytest

pytest.importorskip('rclpy')

from agv_motion.ros import complaints, log_callers
from agv_motion.ros.log_callers import note_log_callers
from agv_motion.ros.refusals import Refusals


def test_a_line_in_the_log_does_not_look_at_the_files_of_all_modules(monkeypatch):
    from rclpy.logging import get_logger

    looked = []
    monkeypatch.setattr(log_callers, 'SEEN', set())
    for name in ('modulesbyfile', '_filesbymodname'):
        monkeypatch.setattr(inspect, name, {})
    resolve = inspect.getabsfile
    monkeypatch.setattr(
        inspect, 'getabsfile', lambda *given: (looked.append(given[0]), resolve(*given))[1]
    )
    note_log_callers()
    complaints.Complaints(get_logger('loud'), lambda: 0.0).warn('once')
    assert looked == []


def test_what_is_noted_is_what_inspect_finds(monkeypatch):
    monkeypatch.setattr(log_callers, 'SEEN', set())
    monkeypatch.setattr(inspect, 'modulesbyfile', {})
    note_log_callers()
    noted = dict(inspect.modulesbyfile)
    assert noted[complaints.__file__] == 'agv_motion.ros.complaints'
    assert {sys.modules[name].__file__ for name in noted.values()} == set(noted)
    assert inspect.getmodule(Refusals.line.__code__).__name__ == 'agv_motion.ros.refusals'


def test_modules_that_are_imported_later_are_noted_by_the_next_node(monkeypatch, tmp_path):
    monkeypatch.setattr(log_callers, 'SEEN', set())
    note_log_callers()
    monkeypatch.setattr(inspect, 'modulesbyfile', {})
    late = ModuleType('agv_motion.late')
    late.__file__ = str(tmp_path / 'late.py')
    monkeypatch.setitem(sys.modules, 'agv_motion.late', late)
    note_log_callers()
    assert inspect.modulesbyfile == {late.__file__: 'agv_motion.late'}
