"""Commands are imported when they are asked for, and nothing of them is lost by that."""

from __future__ import annotations

import subprocess
import sys

import pytest
import typer
from typer.testing import CliRunner

from agv_motion.cli.lazy_group import flowing
from agv_motion.cli.main import app


def commands_of(command, name=()):
    """Yield every command and group below ``command``, each after its words."""
    yield name, command
    for word, below in getattr(command, 'commands', {}).items():
        yield from commands_of(below, (*name, word))


def test_every_command_tells_what_it_is_for():
    found = [words for words, _ in commands_of(typer.main.get_command(app))]
    assert len(found) > 30
    for words in found:
        result = CliRunner().invoke(app, [*words, '--help'])
        assert result.exit_code == 0, words
        assert len(result.output) > 200, words


def test_help_fills_the_terminal_and_examples_keep_a_line_each():
    text = 'Does it.\n\nIn\ntwo lines. Examples:\n\nagv a\n\nagv b\n\nExample: agv c\n  -d'
    expected = 'Does it.\n\nIn two lines. Examples:\nagv a\nagv b\n\nExample: agv c\n  -d'
    assert flowing(text) == expected
    for words, command in commands_of(typer.main.get_command(app)):
        for paragraph in (command.help or '').split('\n\n'):
            begun = [line for line in paragraph.split('\n')[1:] if not line.startswith('agv ')]
            assert all(line.startswith(' ') for line in begun), words


@pytest.mark.parametrize('number', ['nan', 'inf', '-inf', '1e300'])
def test_no_option_takes_a_number_that_is_not_finite_or_hardly_so(number):
    """It would pass every range, and `agv demo --minutes nan` would never end."""
    tried = 0
    for words, command in commands_of(typer.main.get_command(app)):
        for option in command.params:
            if 'float' in type(option.type).__name__.lower():
                with pytest.raises(typer.BadParameter, match=r'finite|range|larger'):
                    command.make_context(words[-1], [option.opts[0], number])
                tried += 1
    assert tried > 40


PROGRAM = """
import sys
from agv_motion.cli.main import main
sys.argv = ["agv", "bag", "export", "-h"]
try:
    main()
except SystemExit:
    heavy = "matplotlib", "mcap", "networkx", "rclpy", "rosbags", "scipy", "shapely"
    print([module for module in heavy if module in sys.modules])
"""


def test_a_question_for_help_loads_nothing_heavy():
    done = subprocess.run(  # noqa: S603 - our own command
        [sys.executable, '-c', PROGRAM], capture_output=True, text=True, check=True
    )
    assert done.stdout.endswith('[]\n')


def test_a_command_that_does_not_exist_is_told_what_was_meant():
    result = CliRunner().invoke(app, ['bag', 'exprt'])
    assert result.exit_code == 2
    assert 'export' in result.output


@pytest.mark.parametrize(
    ('words', 'option', 'command'),
    [
        (['demo', '--no-page', 'omni'], '--page', 'omni'),
        (['demo', '--seed', '1', 'trees'], '--seed', 'trees'),
        (['dashboard', '--port', '9123', 'no_such_bag'], '--port', 'bag'),
        (['dashboard', '--state-folder', 'mine', 'user', 'list'], '--state-folder', 'user'),
    ],
)
def test_an_option_before_a_command_of_its_own_is_refused(words, option, command):
    result = CliRunner().invoke(app, words, env={'COLUMNS': '200'})
    assert result.exit_code == 2
    assert option in result.output
    assert f"stands before '{command}' and would count for nothing: give it after" in result.output


def test_square_brackets_are_shown_as_they_are():
    """Units are written in them, and `rich` takes them for markup."""
    assert '[m/s]' in CliRunner().invoke(app, ['drive', 'to', '--help']).output
