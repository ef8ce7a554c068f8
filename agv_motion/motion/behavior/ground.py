"""The ground under a tree: whether all of it stands in its zone, and what the floor allows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.activity import Activity, Cause
from agv_motion.errors import GeometryError
from agv_motion.motion.behavior.decision import Decision, resting, stopped
from agv_motion.motion.behavior.homing import OutsideZone
from agv_motion.motion.command.floor_rules import FloorRules

if TYPE_CHECKING:
    from agv_motion.motion.behavior.goals.goal import Goal
    from agv_motion.motion.behavior.homing import HomeParameters
    from agv_motion.motion.behavior.sap_flow import SapFlow
    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.motion.navigation.zone import Zone
    from agv_motion.planar import Pose


class Ground:
    """What a zone says of a pose, asked once: poses come less often than decisions."""

    def __init__(self, zone: Zone | None, platform_radius: float, home: HomeParameters) -> None:
        """Stand nowhere yet.

        Args:
            zone: Of the tree; None: it may stand and turn anywhere.
            platform_radius: How far the platform reaches from its centre [m].
            home: What to do outside.

        """
        self.inside, self.rules = True, FloorRules()
        self._zone, self._radius, self._home = zone, platform_radius, home
        self._seen: Pose | None = None

    def look(self, pose: Pose) -> None:
        """Ask the zone about a pose, unless it was the last that was asked about."""
        if pose == self._seen:
            return
        self._seen = pose
        if self._zone is not None:
            self.inside = self._zone.holds(pose.x, pose.y)
            self.rules = FloorRules(self._zone.may_turn(pose.x, pose.y, self._radius))

    def leave(self, here: Point, flow: SapFlow, goal: Goal | None, *, asleep: bool) -> Decision:
        """Return what a tree does that is not `inside`: refuse to move, or return to its zone."""
        assert self._zone is not None
        why = f'the tree {self._zone.why_not(*here)}'
        if OutsideZone(self._home.outside) is OutsideZone.REFUSE:
            return stopped(f'{why}; drive it back, or set home.outside to return', goal)
        if asleep:
            return resting(f'the sap stands, and {why}', goal, Cause.SAP)
        try:
            back = self._zone.way_back(*here)
        except GeometryError as error:
            return stopped(str(error), goal)
        return Decision(
            f'returning slowly to the zone: {why}', goal, back, flow.s1, straight=True,
            rules=FloorRules(may_turn=True, top_speed=self._home.return_speed),
            activity=Activity.WALKING, because=Cause.ZONE,
        )  # fmt: skip
