"""The `agv` command: everything that a person types."""

from __future__ import annotations

import errno
import os
import sys

import typer

from agv_motion.cli import (
    INTERRUPTED,
    bag,
    calibrate,
    demo,
    doctor,
    drive,
    nodes,
    parameters,
    plot,
    record,
    replay,
    reprocess,
    route,
    sequence,
    topic,
)  # fmt: skip
from agv_motion.cli.terminal import escape_help
from agv_motion.errors import AgvMotionError
from agv_motion.ros.stop import interrupt

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode='rich',
    context_settings={'help_option_names': ['-h', '--help']},
    help='Motion of slow, sensor-driven robots on ROS 2. Start with `agv demo`; when '
    'something does not work, with `agv doctor`.',
)
app.add_typer(topic.app, name='topic')
app.add_typer(nodes.app, name='nodes')
app.add_typer(drive.app, name='drive')
app.command(
    context_settings={'allow_extra_args': True, 'ignore_unknown_options': True},
)(nodes.run)
app.command()(parameters.parameters)
app.command()(route.route)
app.command(
    context_settings={'allow_extra_args': True, 'ignore_unknown_options': True},
)(sequence.sequence)
app.add_typer(demo.app, name='demo')
app.command()(calibrate.calibrate)
app.command()(record.record)
app.command()(plot.plot)
app.command()(replay.replay)
app.command()(reprocess.reprocess)
app.add_typer(bag.app, name='bag')
app.command()(doctor.doctor)


def main() -> None:
    """Run the command; errors are told in one line, and a closed pipe or terminal is no error.

    SIGTERM and SIGHUP end it as Ctrl-C does, where the command has no end of its own.
    """
    interrupt()
    try:
        command = typer.main.get_command(app)
        escape_help(command)
        command(standalone_mode=True)
    except AgvMotionError as error:
        typer.echo(f'error: {error}', err=True)
        sys.exit(1)
    except ModuleNotFoundError as error:
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
            typer.echo(f'error: {error}', err=True)
            sys.exit(1)
        for stream in (sys.stdout, sys.stderr) if error.errno == errno.EIO else (sys.stdout,):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        sys.exit(0)


if __name__ == '__main__':
    main()
