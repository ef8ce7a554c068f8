"""What a node says that its robot does: in words where they change, and since when for programs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from std_msgs.msg import String

from agv_motion.activity import Activity, Cause, Doing
from agv_motion.ros.qos import LATCHED

if TYPE_CHECKING:
    from agv_motion.ros.port import Port


class StateReport:
    """One latched topic of words, and the activity that the diagnostics tell."""

    def __init__(self, port: Port, topic: str) -> None:
        """Open the topic; the robot is starting, and nothing is told."""
        self.doing = Doing('', Activity.STARTING, Cause.NOTHING)
        """as it was told last"""
        self._port = port
        self._since = port.seconds()
        self._publisher = port.publisher(String, topic, LATCHED, sole=True)

    @property
    def state(self) -> str:
        """What the robot does, in words, as it was told last."""
        return self.doing.state

    def update(self, doing: Doing) -> None:
        """Tell what the robot does, if that is new; count since when by activity and cause."""
        before, self.doing = self.doing, doing
        if doing == before and self._since > 0.0:
            return
        if doing[1:3] != before[1:3] or self._since <= 0.0:
            self._since = self._port.seconds()
        if doing.state != before.state:
            self._publisher.publish(String(data=doing.state))

    def tell(self, state: str) -> None:
        """Tell the words alone, if they are new; what it does for programs, `note` tells."""
        if state != self.doing.state:
            self.update(self.doing._replace(state=state))

    def note(self, activity: Activity, because: Cause) -> None:
        """Note what the robot does, for programs."""
        self.update(self.doing._replace(activity=activity, because=because))

    def values(self) -> dict[str, str]:
        """Return what the robot does and since when, for programs that read the diagnostics."""
        return {
            'activity': self.doing.activity.value,
            'because': self.doing.because.value,
            'since [s]': f'{self._since:.1f}',
        }
