"""What the shell offers, in a real bash: commands, names of ours, names that are on the graph."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import typer

pytest.importorskip('rclpy')

from agv_motion.cli.graph import completion
from agv_motion.cli.main import app


class Bash:
    """Starts a bash of somebody who has never used the command."""

    def __init__(self, home):
        self.home = home

    def start(self, **options):
        folder = Path(sys.executable).parent
        environment = os.environ | {
            'HOME': str(self.home), 'PATH': f'{folder}:{os.environ["PATH"]}', 'PS1': '> ',
            'INPUTRC': '/dev/null', 'TERM': 'vt100',
        }  # fmt: skip
        words = 'bash', '--norc', '--noprofile', '-i'
        return subprocess.Popen(words, env=environment, **options)  # noqa: S603 - the words are ours


def test_install_completion_makes_a_new_shell_offer_commands_and_names(terminal, oak, tmp_path):
    screen = terminal.func(Bash(tmp_path), columns=120)
    screen.press(b'agv --install-completion; . ~/.bashrc; echo in""stalled\n')
    screen.wait(lambda text: '\ninstalled' in text)
    for typed, completed in (
        (b'agv self', 'agv selftest'),
        (b'agv topic ec', 'agv topic echo'),
        (b'agv run granier', 'agv run granier_probe'),
        (b'agv topic info /ros', 'agv topic info /rosout'),
        (b'agv node info /oak/w', f'agv node info {oak}'),
    ):
        screen.press(b'\x15' + typed + b'\t')  # the line anew
        screen.wait(lambda text, completed=completed: completed in text)
    screen.press(b'\x15exit\n')
    screen.end()


@pytest.mark.parametrize(
    ('words', 'names'),
    [
        ('node info', 'node_names'),
        ('param get', 'node_names'),
        ('param dump', 'node_names'),
        ('lifecycle get', 'node_names'),
        ('topic echo', 'topics'),
        ('topic hz', 'topics'),
        ('service call', 'services'),
        ('service type', 'services'),
    ],
)
def test_names_of_the_graph_are_offered(monkeypatch, words, names):
    asked = []
    monkeypatch.setattr(
        completion, '_offered', lambda begun, of: asked.append(of.__name__) or [f'{begun}/oak']
    )
    command = typer.main.get_command(app)
    context = command.make_context('agv', [], resilient_parsing=True)
    for word in words.split():
        command = command.get_command(context, word)
    offered = command.params[0].shell_complete(context, '/robot')
    assert ([item.value for item in offered], asked) == (['/robot/oak'], [names])


@pytest.mark.parametrize(
    ('word', 'mark'),
    [
        ('bash', 'complete -o default -F'),
        ('zsh', '#compdef '),
        ('fish', 'complete --command '),
    ],
)
def test_the_shell_that_is_named_counts(alone, word, mark):
    status, told, _ = alone('--show-completion', word)
    assert status == 0
    assert mark in told


def test_names_of_ours_are_offered():
    command = typer.main.get_command(app)
    context = command.make_context('agv', [], resilient_parsing=True)
    for word, begun, whole in (('up', 'diff', 'differential'), ('run', 'gran', 'granier_probe')):
        (offered,) = command.get_command(context, word).params[0].shell_complete(context, begun)
        assert offered.value == whole


def test_a_shell_that_nobody_knows_is_refused(alone):
    status, told, errors = alone('--show-completion=tsh')
    assert (status, told) == (2, '')
    assert "'tsh' is not one of" in ' '.join(errors.split())
