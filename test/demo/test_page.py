"""The page beside a demo: there while it runs, gone with it, and no harm where it cannot be."""

from __future__ import annotations

import io
import urllib.error
import urllib.request

import pytest

pytest.importorskip('rclpy')
pytest.importorskip('uvicorn')

from rich.console import Console

from agv_motion.demo import page as module
from agv_motion.demo.page import page


@pytest.fixture
def console():
    return Console(file=io.StringIO(), width=200, markup=False)


def answers(url):
    try:
        return urllib.request.urlopen(f'{url}/health', timeout=5).status == 200  # noqa: S310 - ours
    except (urllib.error.URLError, OSError):
        return False


def test_the_page_is_there_while_the_demo_runs_and_not_after(
    tmp_path, console, wait_until, monkeypatch
):
    monkeypatch.setenv('XDG_STATE_HOME', str(tmp_path))
    with page(tmp_path / 'bag', console):
        told = console.file.getvalue()
        url = told.split()[2]
        assert url.startswith('http://127.0.0.1:80')
        wait_until(lambda: answers(url))
    assert not answers(url)


def test_without_the_extra_a_line_says_so(tmp_path, console, monkeypatch):
    monkeypatch.setattr(module, 'find_spec', lambda name: None)
    with page(tmp_path / 'bag', console):
        pass
    assert 'pip install "agv_motion[dashboard]"' in console.file.getvalue()


def test_nothing_is_said_of_a_page_that_is_not_wanted(tmp_path, console):
    with page(tmp_path / 'bag', console, wanted=False):
        pass
    assert console.file.getvalue() == ''


def test_the_next_port_is_taken_where_one_is_taken(monkeypatch):
    import socket

    with socket.socket() as other:
        other.bind(('127.0.0.1', 0))
        other.listen()
        monkeypatch.setattr(module, 'PORT', other.getsockname()[1])
        assert module.free_port() not in {None, module.PORT}
