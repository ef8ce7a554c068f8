"""The agent in `motion_generator`: alone or among others, in a zone that may change."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.motion.pilot import pilot_alone
from agv_motion.nodes.memory_store import MemoryStore
from agv_motion.nodes.zone_report import ZoneReport, require_standing

if TYPE_CHECKING:
    from agv_motion.motion.behavior.agent import Agent
    from agv_motion.motion.behavior.sap_flow import SapFlow
    from agv_motion.motion.pilot import MotionCommand
    from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
    from agv_motion.nodes.reservation_exchange import ReservationExchange
    from agv_motion.planar import Pose
    from agv_motion.ros.port import Port

DECIDE_PERIOD = 1.0
"""[s] after which the tree decides again though nothing is new: of the hour, and of other paths."""


class TreeAgent:
    """Decides how a tree is to move, and tells the graph what it shares, knows and remembers."""

    def __init__(
        self,
        port: Port,
        given: MotionGeneratorParameters,
        agent: Agent,
        exchange: ReservationExchange | None,
    ) -> None:
        """Give the agent back its memory, and open the topics.

        Args:
            port: Of the node.
            given: Its parameters.
            agent: What decides.
            exchange: With the other trees; None: the tree is alone.

        """
        self.agent, self.exchange = agent, exchange
        self._pilot = pilot_alone(agent)
        self._zone = ZoneReport(port, exchange.others if exchange else ())
        self._store = None if agent.memory is None else MemoryStore(port, agent.memory, given)
        self._motion: MotionCommand | None = None
        self._decided_at = 0.0

    def begin(self) -> None:
        """Decide anew; show the zone, and what is remembered."""
        self._motion = None
        self._zone.publish(self.agent.zone)
        if self._store is not None:
            self._store.begin()

    def end(self, pose: Pose | None) -> None:
        """Say that the tree stays where it is, as far as that is known, and keep what it knows."""
        if self.exchange is not None and pose is not None:
            self.exchange.park(pose)
        if self._store is not None:
            self._store.save_at_last()

    def reconsider(self) -> None:
        """Decide anew when asked next: something has changed."""
        self._motion = None

    def update(self, now: float, pose: Pose, flow: SapFlow) -> MotionCommand:
        """Decide when something is new; also now and then, and always where others walk."""
        if self.exchange is not None:
            return self.exchange.update(now, pose, flow)
        if self._motion is None or not 0.0 <= now - self._decided_at < DECIDE_PERIOD:
            self._motion, self._decided_at = self._pilot.update(now, pose, flow, now), now
        return self._motion

    def stay(self, pose: Pose | None, *, fresh: bool) -> None:
        """Hold the place where the tree stands; ``fresh``: all inputs still come."""
        if self.exchange is not None and pose is not None:
            self.exchange.stay(pose, fresh=fresh)

    def move_to_zone(self, parameters: MotionGeneratorParameters, pose: Pose | None) -> None:
        """Go on in another zone, if the tree stands in it as far as is known.

        Raises:
            AgvMotionError: It is none, or this tree or another stands outside of it.

        """
        planner = parameters.planner(self.agent.home)
        here = require_standing(pose, planner, self.agent.zone)
        if self.exchange is not None:
            self.exchange.require_inside(here.planner.zone)
        agent = self.agent.moved_to(here.planner)
        if self.exchange is not None:
            self.exchange.move_to(agent, here.pose)
        self.agent, self._pilot = agent, pilot_alone(agent)
        if self._store is not None and agent.memory is not None:
            self._store.move_to(agent.memory)
        self._zone.publish(agent.zone)

    def show_memory(self) -> None:
        """Show what is remembered once there is a time to stamp it with."""
        if self._store is not None:
            self._store.publish_first()

    @property
    def alarmed(self) -> bool:
        """Whether something is wrong with the other trees."""
        return self.exchange is not None and bool(self.exchange.alarm)

    def values(self) -> dict[str, str]:
        """Return for the diagnostics where it goes, what it remembers, and who else is there."""
        goal, store, exchange = self.agent.goal, self._store, self.exchange
        values = {} if goal is None else {'goal': goal.reason}
        values |= {} if store is None else store.report()
        values |= {} if exchange is None else exchange.report()
        if different := self._zone.different():
            values['zone differs from'] = ', '.join(different)
        return values
