"""The `agv` command: everything that a person types."""

from __future__ import annotations

import errno
import os
import sys
from io import TextIOWrapper
from itertools import pairwise
from typing import TYPE_CHECKING

import typer

from agv_motion.cli import INTERRUPTED
from agv_motion.cli.lazy_group import HELP, lazy_group
from agv_motion.cli.visible_stream import guard
from agv_motion.errors import AgvMotionError
from agv_motion.ros.stop import interrupt
from agv_motion.visible import indented

if TYPE_CHECKING:
    from collections.abc import Sequence

app = typer.Typer(
    cls=lazy_group(
        {
            'topic': 'topic.group:app',
            'node': 'node.group:app',
            'param': 'param.group:app',
            'service': 'service.group:app',
            'lifecycle': 'lifecycle.group:app',
            'interface': 'interface.group:app',
            'nodes': 'nodes.group:app',
            'drive': 'robot.drive:app',
            'why': 'robot.why:why',
            'run': 'nodes.group:run_app',
            'up': 'nodes.up:app',
            'parameters': 'nodes.parameters:parameters',
            'route': 'robot.route:route',
            'sequence': 'robot.sequence:app',
            'demo': 'demo.group:app',
            'dashboard': 'dashboard.group:app',
            'foxglove': 'dashboard.foxglove:foxglove',
            'calibrate': 'robot.calibrate:calibrate',
            'probes': 'probe.probes:probes',
            'record': 'recording.record:record',
            'plot': 'recording.plot:plot',
            'report': 'recording.report:report',
            'replay': 'recording.replay:replay',
            'reprocess': 'recording.reprocess:reprocess',
            'bag': 'bag.group:app',
            'doctor': 'doctor:doctor',
            'selftest': 'selftest:selftest',
        }
    ),
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode='rich',
    context_settings=HELP | {'color': True},  # else typer leaves ESC and more out in a pipe
)


@app.callback()
def agv() -> None:
    """Motion of slow, sensor-driven robots on ROS 2.

    Start with `agv demo`; when something does not work, with `agv doctor`.
    """


COMPLETION = '--install-completion', '--show-completion'


def name_shell(words: Sequence[str]) -> None:
    """Let the shell that is named after `--show-completion` count, not the one that runs this.

    typer takes a name only where it is told not to find out by itself.
    """
    for option in COMPLETION:
        after = [b for a, b in pairwise(words) if a == option and not b.startswith('-')]
        if after or any(word.startswith(f'{option}=') for word in words):
            os.environ['_TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION'] = '1'


def _tell_error(error: object) -> None:
    typer.echo(f'error: {indented(error)}', err=True, color=True)


def main() -> None:
    """Run the command; errors are told in one line, and a closed pipe or terminal is no error.

    SIGTERM and SIGHUP end it as Ctrl-C does, where the command has no end of its own.
    """
    interrupt()
    name_shell(sys.argv[1:])
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors='backslashreplace')  # names of files may be no UTF-8
    guard()
    try:
        typer.main.get_command(app)()
    except AgvMotionError as error:
        _tell_error(error)
        sys.exit(1)
    except ModuleNotFoundError as error:
        from agv_motion.cli import doctor

        name = (error.name or '').partition('.')[0]
        remedy = doctor.how_to_get(name)
        if not remedy:
            raise
        typer.echo(
            f'error: this needs the module {name}, which is not installed: {remedy}; '
            'agv doctor tells what else is missing',
            err=True,
        )
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    except OSError as error:
        if error.errno not in {errno.EPIPE, errno.EIO}:  # nobody reads on; the terminal is gone
            _tell_error(error)
            sys.exit(1)
        for stream in (sys.stdout, sys.stderr) if error.errno == errno.EIO else (sys.stdout,):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        sys.exit(0)


if __name__ == '__main__':
    main()
