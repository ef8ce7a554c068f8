"""What the shell offers, in a real bash: commands, names of ours, names that are on the graph."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip('rclpy')


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


def test_install_completion_makes_a_new_shell_offer_commands_and_names(terminal, tmp_path):
    screen = terminal.func(Bash(tmp_path), columns=120)
    screen.press(b'agv --install-completion; . ~/.bashrc; echo in""stalled\n')
    screen.wait(lambda text: '\ninstalled' in text)
    for typed, completed in (
        (b'agv self', 'agv selftest'),
        (b'agv topic ec', 'agv topic echo'),
        (b'agv up diff', 'agv up differential'),
        (b'agv run granier', 'agv run granier_probe'),
        (b'agv topic info /ros', 'agv topic info /rosout'),
    ):
        screen.press(b'\x15' + typed + b'\t')  # the line anew
        screen.wait(lambda text, completed=completed: completed in text)
    screen.press(b'\x15exit\n')
    screen.end()


@pytest.mark.parametrize(
    'words', ['agv node info /oak', 'agv param get /oak', 'agv lifecycle get ']
)
def test_nodes_of_the_graph_are_offered(alone, oak, words):
    asked = words.split(' ')
    environment = os.environ | {
        '_AGV_COMPLETE': 'complete_bash', 'COMP_WORDS': words, 'COMP_CWORD': str(len(asked) - 1),
    }  # fmt: skip
    folder = Path(sys.executable).parent
    told = subprocess.run(  # noqa: S603 - the words are ours
        [folder / 'agv'], env=environment, capture_output=True, text=True, check=False
    )
    offered = told.stdout.split()  # others may be on the graph
    assert oak in offered, told.stderr
    assert all(name.startswith(asked[-1] or '/') for name in offered)


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


def test_a_shell_that_nobody_knows_is_refused(alone):
    status, told, errors = alone('--show-completion=tsh')
    assert (status, told) == (2, '')
    assert "'tsh' is not one of" in ' '.join(errors.split())
