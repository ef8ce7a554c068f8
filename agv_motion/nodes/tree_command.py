"""What `motion_generator` commands: a polar command held within its limits, as the twist it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.motion.command.limits import CommandLimits, Limited
from agv_motion.motion.command.polar import to_twist
from agv_motion.planar import REST
from agv_motion.ros.twist_rows import twist_publisher

if TYPE_CHECKING:
    from agv_motion.motion.pilot import MotionCommand
    from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
    from agv_motion.ros.port import Port


class TreeCommand:
    """Publishes `cmd_vel`."""

    def __init__(self, port: Port, given: MotionGeneratorParameters) -> None:
        """Open the topic, and command nothing yet."""
        self._given, self._rim = given, given.rim
        self.limited_by: tuple[str, ...] = ()
        """the limits that held the last command back"""
        self.twist = REST
        """what was commanded last"""
        self._limits = CommandLimits.of(given.limits)
        self._publish = twist_publisher(port, given.base_frame, stamped=given.stamped)
        self.begin(port.seconds())

    def begin(self, now: float) -> None:
        """Let the first command be one of a step from ``now`` [s]."""
        self._at = now

    def move(self, motion: MotionCommand, now: float) -> None:
        """Command a motion as far as the limits let it.

        After a hiccup the command goes on from where it was, as if no time had passed.
        """
        dt = min(max(now - self._at, 0.0), 2.0 / self._given.rate)
        self._send(self._limits.apply(motion.wanted, motion.rules, dt))

    def stop(self) -> None:
        """Command an explicit zero."""
        self._send(self._limits.stop())

    def _send(self, limited: Limited) -> None:
        self.limited_by = limited.by
        self.twist = to_twist(limited.command, self._given.linear_speed, self._rim)
        # when it is said, not when the decision began: by their stamps the rates hold
        self._at = self._publish(self.twist)
