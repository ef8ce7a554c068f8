"""The beginning of a ROS context: signals stay ours, and logs are kept somewhere."""

from __future__ import annotations

from typing import Any

import rclpy
from rclpy.signals import SignalHandlerOptions

from agv_motion.ros.log_folder import keep_logs


def begin_context(**options: Any) -> None:
    """Begin a context of rclpy that leaves Ctrl-C and SIGTERM to the process (`ros/stop.py`).

    Args:
        options: Of `rclpy.init`, such as ``args`` and ``context``; without a context it is that of
            the process.

    Raises:
        OSError: Logs cannot be kept anywhere.

    """
    keep_logs()
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO, **options)
