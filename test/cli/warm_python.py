"""A Python that has imported what commands import, and forks for each: real processes, soon there.

A process of its own for each command costs a second of processor, nearly all of it for imports.
`conftest.py` starts this one and asks it, over the socket that is its standard input, for processes
with arguments, a folder, an environment and standard streams. The answer is a number: the process
is a child of who asked, since its parent here ends at once.
"""

from __future__ import annotations

import atexit
import fcntl
import gc
import json
import os
import pkgutil
import runpy
import socket
import sys
import termios
from contextlib import suppress
from importlib import import_module
from io import BytesIO

import matplotlib as mpl
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped
from lifecycle_msgs.srv import GetState
from matplotlib import pyplot as plt
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import ParameterEvent
from rclpy.serialization import serialize_message
from rclpy.utilities import get_rmw_implementation_identifier
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import Trigger
from typer.testing import CliRunner
from visualization_msgs.msg import MarkerArray

import agv_motion

MAIN = 'agv_motion.cli.main'
"""What runs in each fork, and is therefore not there before it"""
OTHERS = (
    '_strptime', 'numpy.random', 'rclpy.executors', 'rclpy.lifecycle',
    'rclpy.topic_or_service_is_hidden', 'rosbags.serde.primitives', 'rosbags.typesys.stores.empty',
    'type_description_interfaces.msg',
)  # fmt: skip
REHEARSED = ['--help'], ['bag', 'info', 'nothing'], ['bag', 'plot', '--help']
MESSAGES = (
    Clock, DiagnosticArray, GetState.Request, GetState.Response, JointState, MarkerArray, Odometry,
    ParameterEvent, PoseWithCovarianceStamped, String, Trigger.Request, TwistStamped,
)  # fmt: skip


def import_all():
    """Import the package, and by use what others import late; no thread may come of it."""
    for module in pkgutil.walk_packages(agv_motion.__path__, 'agv_motion.'):
        if module.name != MAIN:
            import_module(module.name)
    for name in OTHERS:
        import_module(name)
    draw_something()
    for words in REHEARSED:
        CliRunner().invoke(import_module(MAIN).app, words)
    del sys.modules[MAIN]
    for kind in MESSAGES:
        serialize_message(kind())
    get_rmw_implementation_identifier()
    gc.collect()
    gc.freeze()  # what is there stays: no fork need look at it again


def draw_something():
    """Let matplotlib import what it draws with, and find its fonts."""
    mpl.use('Agg')
    drawn, axes = plt.subplots(layout='constrained')
    axes.plot([0.0, 1.0], label='a')
    axes.legend(title='Name')
    drawn.savefig(BytesIO(), format='png')
    plt.close(drawn)


def asked(line):
    """Fork for each request until the line is closed; return in the forks: what to be, streams."""
    told, tell = os.pipe()
    while True:
        request, streams, *_ = socket.recv_fds(line, 1 << 17, 3)
        if not request:
            sys.exit()
        between = os.fork()
        if not between:
            own = os.fork()
            if not own:
                return json.loads(request), streams
            os.write(tell, own.to_bytes(4, 'little'))
            os._exit(0)
        os.waitpid(between, 0)
        line.send(os.read(told, 4))
        for stream in streams:
            os.close(stream)


def become(given, streams):
    """Take folder, environment and streams, and run the module that is asked for as a program."""
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    sys.stdin = open(0, closefd=False)  # noqa: SIM115 - the process's own
    sys.stdout = open(1, 'w', buffering=1 if os.isatty(1) else -1, closefd=False)  # noqa: SIM115
    sys.stderr = open(2, 'w', buffering=1, errors='backslashreplace', closefd=False)  # noqa: SIM115
    if given['session']:
        os.setsid()
        if os.isatty(0):  # whose Ctrl-C is for us
            fcntl.ioctl(0, termios.TIOCSCTTY, 0)
    os.chdir(given['folder'])
    os.environ.clear()
    os.environ.update(given['environment'])
    sys.argv[1:] = given['arguments']
    status = []
    atexit.register(leave, status)  # the first, and so the last to be called
    try:
        runpy.run_module(MAIN, run_name='__main__', alter_sys=True)
    except SystemExit as end:
        status += [end.code or 0] if isinstance(end.code, int | None) else []
        raise


def leave(status):
    """End at once where a command gave its status: to take all modules apart costs more than it."""
    with suppress(OSError, ValueError):
        sys.stdout.flush()
        sys.stderr.flush()
        if status:
            os._exit(status[0])


if __name__ == '__main__':
    import_all()
    with socket.socket(fileno=os.dup(0)) as requests:
        mine, passed = asked(requests)
    become(mine, passed)
