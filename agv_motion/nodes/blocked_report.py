"""What a node does about a robot that is blocked: it looks, and says in the log what it found."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.blocked import BlockedGuard
from agv_motion.nodes.obedience import Obedience

if TYPE_CHECKING:
    from agv_motion.blocked import BlockedParameters
    from agv_motion.planar import Pose, Twist
    from agv_motion.ros.port import Port


class BlockedReport(BlockedGuard):
    """A guard that tells when it stops the robot, and when it lets it try again.

    A robot that stands since somebody else drives it, or has stopped it, is not blocked.
    """

    def __init__(
        self, port: Port, parameters: BlockedParameters, arm: float, remedy: str, longest: float
    ) -> None:
        """Let the robot move.

        Args:
            port: Of the node.
            parameters: When it is blocked, and what then.
            arm: Distance from the centre at which a turn is measured as a motion [m].
            remedy: What a person can do, for the reason.
            longest: Time between two looks that counts, at most [s]: nobody has looked meanwhile.

        """
        super().__init__(parameters, arm, remedy)
        self._port = port
        self._obedience = Obedience(port)
        self._looked_at, self._longest = port.seconds(), longest

    def look(self, parameters: BlockedParameters, pose: Pose | None, twist: Twist) -> bool:
        """Return whether the robot has been found blocked just now.

        Args:
            parameters: When it is blocked, and what then.
            pose: As it is measured now; None while it is not.
            twist: Told since the last look.

        """
        now = self._port.seconds()
        dt, self._looked_at = min(max(now - self._looked_at, 0.0), self._longest), now
        self.watch.parameters = parameters
        before = self.reason
        found = self.update(None if self._obedience.held else pose, twist, dt)
        if found:
            self._port.error(self.reason)
        elif before and not self.reason:
            self._port.info('blocked before: trying again')
        return found
