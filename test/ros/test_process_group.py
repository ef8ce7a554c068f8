"""Several programs as one: names before lines, an end for all, one that dies is told."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest

from agv_motion.ros import process_group
from agv_motion.ros.process_group import ProcessGroup

FOR_EVER = 'trap "echo zero; exit 0" INT; echo up; while :; do sleep 0.05; done'


def shell(text):
    return ['/bin/sh', '-c', text]


def test_lines_have_names_and_all_are_ended():
    shown = []
    group = ProcessGroup(
        {'a': shell(FOR_EVER), 'b': shell(f'printf half; {FOR_EVER}')}, shown.append, respawn=False
    )
    group.run(lambda: {'[a] up', '[b] halfup'} <= set(shown))
    assert sorted(shown) == ['[a] up', '[a] zero', '[b] halfup', '[b] zero']
    assert not group.failed


def test_one_that_dies_is_told_and_the_others_go_on():
    shown = []
    group = ProcessGroup(
        {'a': shell(FOR_EVER), 'b': shell('printf last; exit 3'), 'c': shell('kill -9 $$')},
        shown.append, respawn=False,
    )  # fmt: skip
    group.run(lambda: sum('ended' in line for line in shown) == 2 and '[a] up' in shown)
    assert shown.index('[b] last') < shown.index('[b] ended with exit status 3, the others go on')
    assert '[c] ended by signal 9 (SIGKILL), the others go on' in shown
    assert shown[-1] == '[a] zero'
    assert group.failed


def test_it_ends_when_none_is_left():
    shown = []
    group = ProcessGroup({'a': shell('exit 1')}, shown.append, respawn=False)
    group.run(lambda: False)
    assert shown == ['[a] ended with exit status 1']
    assert group.failed


def test_one_that_dies_is_started_again_if_asked(monkeypatch):
    monkeypatch.setattr(process_group, 'RESPAWN_DELAY', 0.05)
    shown = []
    group = ProcessGroup({'a': shell('echo up; exit 1')}, shown.append, respawn=True)
    group.run(lambda: shown.count('[a] up') == 3)
    assert '[a] ended with exit status 1: starting it again in 0.05 s' in shown


def test_one_that_is_deaf_is_killed_and_that_is_told(monkeypatch):
    monkeypatch.setattr(process_group, 'LAST_WORD', 0.2)
    monkeypatch.setattr(process_group, 'LONGEST', 0.2)
    shown = []
    deaf = shell('trap "" INT TERM; echo up; while :; do sleep 0.05; done')
    group = ProcessGroup({'a': deaf}, shown.append, respawn=False)
    group.run(lambda: '[a] up' in shown)
    assert '[a] does not end: killed, so it sent no zero' in shown
    assert group.failed


def test_what_cannot_be_shown_ends_all_the_same():
    shown = []

    def show(line):
        shown.append(line)
        if line == '[a] up':
            raise BrokenPipeError

    group = ProcessGroup({'a': shell(FOR_EVER)}, show, respawn=False)
    with pytest.raises(BrokenPipeError):
        group.run(lambda: False)
    assert shown[-1] == '[a] zero'


def test_they_end_when_whoever_started_them_is_killed():
    program = (
        'from agv_motion.ros.process_group import ProcessGroup\n'
        'import functools\n'
        'words = ["/bin/sh", "-c", "trap \'exit 0\' INT; echo $$; while :; do sleep 0.05; done"]\n'
        'ProcessGroup({"a": words}, functools.partial(print, flush=True), respawn=False)'
        '.run(lambda: False)'
    )
    with subprocess.Popen([sys.executable, '-c', program], stdout=subprocess.PIPE) as parent:  # noqa: S603
        number = int(parent.stdout.readline().decode().removeprefix('[a] '))
        watch = os.pidfd_open(number)
        parent.kill()
    import select

    assert select.select([watch], [], [], 30.0)[0]  # readable once it has ended
    os.close(watch)
    assert parent.returncode == -signal.SIGKILL


def test_they_hear_ctrl_c_though_a_script_has_made_us_deaf_to_it():
    """What a shell starts in the background ignores SIGINT, and would hand that on."""
    shown = []
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        ProcessGroup({'a': shell(FOR_EVER)}, shown.append, respawn=False).run(
            lambda: '[a] up' in shown
        )
    finally:
        signal.signal(signal.SIGINT, before)
    assert shown == ['[a] up', '[a] zero']
