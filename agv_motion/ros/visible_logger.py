"""The log of a node, in which the text of others is seen and never obeyed."""

from __future__ import annotations

from typing import Any

from rclpy.impl import rcutils_logger

from agv_motion.visible import visible

# rclpy asks who calls, for the place in the log and to count what is said seldom: not this file
rcutils_logger._internal_callers.append(__file__)  # noqa: SLF001 - kept there for such files


class VisibleLogger(rcutils_logger.RcutilsLogger):
    """Logs as rclpy does; what a terminal would obey is written out (`agv_motion.visible`).

    Names, reasons and lines of a wire come from outside and end in the log, which people read in a
    terminal and others from `/rosout`.
    """

    def log(self, message: Any, severity: Any, **filters: Any) -> bool:
        """Log a message; return whether its filters let it pass."""
        return bool(super().log(visible(str(message)), severity, **filters))
