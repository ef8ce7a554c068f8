"""Where ROS keeps its logs: in another folder where its own cannot be written, not nowhere at all.

A robot whose disk is read-only, and a user without a home, would else be refused by rclpy.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path


def log_folder() -> Path:
    """Return where ROS 2 keeps its logs: ``ROS_LOG_DIR``, or ``log`` in ``ROS_HOME`` or ~/.ros."""
    home = os.environ.get('ROS_HOME') or '~/.ros'
    return Path(os.environ.get('ROS_LOG_DIR') or f'{home}/log').expanduser()


def keep_logs() -> None:
    """Let ROS keep its logs in a temporary folder, and say so, where its own cannot be written.

    To be called before the first ``rclpy.init`` of a process.

    Raises:
        OSError: No other folder can be written either.

    """
    folder = log_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        why = '' if os.access(folder, os.W_OK | os.X_OK) else 'it may not be written'
    except OSError as error:
        why = error.strerror or str(error)
    if not why:
        return
    other = Path(tempfile.gettempdir()) / f'ros_log_{os.getuid()}'
    other.mkdir(mode=0o700, exist_ok=True)
    os.environ['ROS_LOG_DIR'] = str(other)
    said = f'logs of ROS are kept in {other}: {folder} cannot be used ({why}); set ROS_LOG_DIR'
    print(said, file=sys.stderr)  # noqa: T201 - before there is a log
