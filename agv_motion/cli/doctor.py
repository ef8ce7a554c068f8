"""`agv doctor`: what is installed, what is missing, how to get it, and whether ROS talks."""

from __future__ import annotations

import importlib
import importlib.metadata
import os
import platform
import shutil
import sys
import time
from typing import Annotated, NamedTuple

import typer
from rich.text import Text

from agv_motion.cli.terminal import LineTable, terminal


class DoctorFinding(NamedTuple):
    """One line of the report."""

    what: str
    state: str
    needed: bool
    remedy: str


MODULES = (
    # module, distribution, needed, what to do
    ('rclpy', 'ros-jazzy-rclpy', True, 'pip install "agv_motion[ros]", or source a ROS 2 Jazzy'),
    ('geometry_msgs', 'ros-geometry-msgs', True, 'pip install "agv_motion[ros]"'),
    ('numpy', 'numpy', True, 'pip install numpy'),
    ('rosbags', 'rosbags', True, 'pip install rosbags'),
    ('yaml', 'pyyaml', True, 'pip install pyyaml'),
    ('shapely', 'shapely', True, 'pip install shapely'),
    ('serial', 'pyserial', True, 'pip install pyserial (probes on a serial line)'),
    ('matplotlib', 'matplotlib', False, 'pip install "agv_motion[plot]" (figures)'),
    ('tf2_msgs', 'tf2_msgs', False, 'comes with a ROS installation (/tf)'),
    ('nav2_msgs', 'nav2_msgs', False, "comes with a ROS installation (Nav2's actions)"),
    ('ros2cli', 'ros2cli', False, 'comes with a ROS installation; agv topic stands in for it'),
)
EXTRAS = {
    'pyarrow': 'parquet', 'distributed': 'cluster', 'dask': 'cluster',
    'starlette': 'dashboard', 'uvicorn': 'dashboard', 'websockets': 'dashboard',
    'argon2': 'dashboard', 'paho': 'mqtt',
}  # fmt: skip
"""Modules that a few options want, and the extra that brings each"""

COMMANDS = (
    ('colcon', 'pip install colcon-common-extensions colcon-ros (building in a workspace)'),
    ('node', 'apt install nodejs (the independent bag reader in the tests)'),
)
SURROUNDINGS = (
    'ROS_DOMAIN_ID', 'ROS_AUTOMATIC_DISCOVERY_RANGE', 'ROS_STATIC_PEERS', 'RMW_IMPLEMENTATION',
    'AMENT_PREFIX_PATH',
)  # fmt: skip


def doctor(
    *,
    json: Annotated[bool, typer.Option('--json', help='For other programs.')] = False,
    talk: Annotated[bool, typer.Option(help='Try whether two nodes hear each other.')] = True,
) -> None:
    """Tell what is installed, what is missing, and how to get it.

    Exit status 1 when something needed is missing. Example: agv doctor --no-talk
    """
    findings = [DoctorFinding('python', platform.python_version(), True, 'Python 3.10 or newer')]  # noqa: FBT003 - a row
    findings += [_module(*row) for row in MODULES]
    findings += [
        DoctorFinding(name, shutil.which(name) or 'missing', False, remedy)  # noqa: FBT003 - a row
        for name, remedy in COMMANDS
    ]
    findings += [
        DoctorFinding(name, os.environ.get(name, 'not set'), False, '')  # noqa: FBT003 - a row
        for name in SURROUNDINGS
    ]
    if talk and not any(f.state == 'missing' for f in findings if f.what == 'rclpy'):
        findings.append(_talk())
    if json:
        import json as encoder

        typer.echo(encoder.dumps([finding._asdict() for finding in findings], indent=2))
    else:
        _print(findings)
    if any(finding.needed and _bad(finding) for finding in findings):
        sys.exit(1)


def how_to_get(module: str) -> str:
    """Return what to do where a module is missing; empty for one of which nothing is known."""
    if module in EXTRAS:
        return f'pip install "agv_motion[{EXTRAS[module]}]"'
    known = {name: remedy for name, _, _, remedy in MODULES}
    ros = module.endswith(('_msgs', '_interfaces')) or module.startswith(('ros', 'ament_'))
    return known.get(module) or (known['rclpy'] if ros else '')


def _bad(finding: DoctorFinding) -> bool:
    return finding.state == 'missing' or finding.state.startswith('failed')


def _module(module: str, distribution: str, needed: bool, remedy: str) -> DoctorFinding:  # noqa: FBT001 - a row of the table
    try:
        importlib.import_module(module)
    except ImportError as error:
        missing = isinstance(error, ModuleNotFoundError)
        return DoctorFinding(module, 'missing' if missing else f'failed: {error}', needed, remedy)
    try:
        return DoctorFinding(module, importlib.metadata.version(distribution), needed, '')
    except importlib.metadata.PackageNotFoundError:
        return DoctorFinding(module, 'installed', needed, '')


def _talk() -> DoctorFinding:
    """Send a message from one participant to another and time it."""
    import rclpy
    from std_msgs.msg import String

    from agv_motion.ros.context import begin_context

    remedy = 'look at ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE and the firewall'
    contexts = [rclpy.Context(), rclpy.Context()]
    heard: list[float] = []
    try:
        for context in contexts:
            begin_context(context=context)
        speaker, listener = (
            rclpy.create_node(f'_agv_doctor_{i}', context=context)
            for i, context in enumerate(contexts)
        )
        topic = f'_agv_doctor_{os.getpid()}'
        listener.create_subscription(String, topic, lambda _: heard.append(time.monotonic()), 1)
        publisher = speaker.create_publisher(String, topic, 1)
        start = time.monotonic()
        executor = rclpy.executors.SingleThreadedExecutor(context=contexts[1])
        executor.add_node(listener)
        while publisher.get_subscription_count() == 0 and time.monotonic() - start < 5.0:
            time.sleep(0.01)
        sent = time.monotonic()
        publisher.publish(String(data='hello'))
        while not heard and time.monotonic() - sent < 2.0:
            executor.spin_once(timeout_sec=0.05)
    finally:
        for context in contexts:
            rclpy.try_shutdown(context=context)
    if not heard:
        return DoctorFinding('two participants', 'failed: no message came through', True, remedy)  # noqa: FBT003 - a row
    state = f'hear each other: found in {sent - start:.2f} s, {(heard[0] - sent) * 1e3:.1f} ms'
    return DoctorFinding('two participants', state, True, '')  # noqa: FBT003 - a row


def _print(findings: list[DoctorFinding]) -> None:
    table = LineTable()
    for column in ('what', 'state', 'what to do'):
        table.add_column(column, overflow='fold')
    for finding in findings:
        bad = _bad(finding)
        colour = ('red' if finding.needed else 'yellow') if bad else 'green'
        state = Text(finding.state, style=colour)
        table.add_row(finding.what, state, finding.remedy if bad else '')
    terminal().print(table)
