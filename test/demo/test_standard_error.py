"""Logs that go past Python to standard error come out as whole lines, all of them, in order."""

from __future__ import annotations

import os

import pytest

from agv_motion.demo.standard_error import apart


def test_whole_lines_now_and_the_rest_at_the_end(capfd):
    shown = []
    with apart(shown.append) as show:
        show()
        os.write(2, b'one\ntwo\nhal')
        show()
        assert shown == ['one\ntwo']
        os.write(2, b'f\n')
        show()
        assert shown == ['one\ntwo', 'half']
        os.write(2, b'last')
    assert shown == ['one\ntwo', 'half', 'last']
    os.write(2, b'after\n')
    assert capfd.readouterr().err == 'after\n'


def test_much_is_no_matter():
    shown = []
    with apart(shown.append):
        os.write(2, b'x' * 300_000 + b'\n')
    assert len(shown[0]) == 300_000


def test_what_was_logged_before_an_error_is_shown(capfd):
    shown = []

    def fail():
        with apart(shown.append):
            os.write(2, b'why it failed\n')
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail()
    assert shown == ['why it failed']
    os.write(2, b'after\n')
    assert capfd.readouterr().err == 'after\n'
