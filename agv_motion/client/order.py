"""An order that a robot carries out: judged by what the robot says, and by its silence."""

from __future__ import annotations

from math import dist, isfinite, nan
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.client.drivers import TREE
from agv_motion.client.progress import RemainingPath, StandWatch
from agv_motion.client.task import Fault, Outcome, Task
from agv_motion.ros.messages import points_of, seconds_of

if TYPE_CHECKING:
    from agv_motion.client.drivers import Driver
    from agv_motion.client.link import Heard
    from agv_motion.client.view import RobotView


PLACES = 'pose', 'odom', 'fix'
"""Topics that tell where a robot is"""


SAME_PLACE = 0.01
"""[m]"""


class Patience(NamedTuple):
    """How long a script waits for a robot, always by the steady clock."""

    answer: float
    """[s] for a node to be found, and to answer"""
    silence: float
    """[s] without a word of the node that drives, or of the wheels, after which an order fails"""
    standing: float
    """[s] for which the robot may stand, whatever for, before an order fails"""


class Order:
    """One order: the node that has it, its path and its end."""

    def __init__(self, driver: Driver, view: RobotView, patience: Patience, now: float) -> None:
        """Be sent.

        Args:
            driver: Node that is to carry it out.
            view: What is heard of the robot.
            patience: For silence and standing.
            now: By the steady clock [s].

        """
        self.driver = driver
        self.task = Task(driver.ends, now)
        self._view, self._patience = view, patience
        self._begun = now
        self._not_before = view.clock_of(driver.node) or 0.0
        """by the clock of the node [s]: what it told before is of another order"""
        self._stand = StandWatch(now)
        self._path = RemainingPath(())

    def receive(self, topic: str, heard: Heard) -> None:
        """Take in a message of the robot."""
        if topic == self.driver.path:
            self._on_path(heard)
        elif topic == self.driver.state:
            self.task.tell(str(heard.message.data))
        elif topic in PLACES:
            if topic == 'odom' and (pose := self._view.odometry) is not None:
                self._stand.look(pose, heard.at)
            self._measure()

    def accept(self, now: float) -> None:
        """Be taken by the node."""
        self.task.accept()
        self._stand.begin(now)

    def look(self, now: float) -> None:
        """End it where the robot was stopped, is silent, or has stood for too long."""
        task, view, patience = self.task, self._view, self._patience
        task.look(now)
        if task.ended or not task.accepted:
            return
        node, since = self.driver.node, now - self._begun
        if view.stop:
            task.end(Outcome.FAILED, f'STOP: {view.stop}; call release(), and order it again',
                     Fault.STOPPED)  # fmt: skip
        elif min(view.silence(node, now), since) > patience.silence:
            task.end(Outcome.FAILED, f'{node} is silent for {patience.silence:g} s: look at it',
                     Fault.SILENT)  # fmt: skip
        elif min(view.odometry_silence(now), since) > patience.silence:
            task.end(Outcome.FAILED, f'no odom for {patience.silence:g} s: look at the wheels',
                     Fault.SILENT)  # fmt: skip
        elif self._stand.seconds(now) > patience.standing:
            reason = view.why(now) or view.state(self.driver)
            task.end(Outcome.FAILED, f'stands for {patience.standing:g} s: {reason}',
                     Fault.STANDS)  # fmt: skip

    def stands(self, now: float) -> bool:
        """Return whether the robot has stood for a second."""
        return self._stand.seconds(now) > 1.0

    def distance_left(self) -> float:
        """Return the way that is left along the path [m]; NaN as long as nobody knows."""
        return self._path.last

    def _on_path(self, heard: Heard) -> None:
        told = seconds_of(heard.message.header.stamp)
        if self.accepts_by_path and told < self._not_before:
            return  # it is latched, and came late
        self._path = RemainingPath(points_of(heard.message), heard.message.header.frame_id)
        self._measure()
        if self.accepts_by_path:
            self.accept(heard.at)

    def _measure(self) -> None:
        here = self._view.pose_in(self._path.frame)
        if here is not None:
            self._path.left(here[:2])

    accepts_by_path = True
    """Whether a new path is how the node tells that it has taken the order"""


class SequenceOrder(Order):
    """A sequence is taken by the answer of its service; its path is told once, too."""

    accepts_by_path = False


class TreeGoal(NamedTuple):
    """Where a tree is to go."""

    place: tuple[float, float]
    """[m] in the map"""
    arrival: float
    """[m] from there at which the tree takes it for reached"""


class TreeOrder(Order):
    """A goal for a tree: reached where it is near; then the tree takes a goal of its own."""

    accepts_by_path = False

    def __init__(self, goal: TreeGoal, view: RobotView, patience: Patience, now: float) -> None:
        """Be sent.

        Args:
            goal: Where to.
            view: What is heard of the tree.
            patience: For silence and standing.
            now: By the steady clock [s].

        """
        super().__init__(TREE, view, patience, now)
        self._place, self._arrival = goal

    def receive(self, topic: str, heard: Heard) -> None:
        """Take in a message of the tree."""
        super().receive(topic, heard)
        if topic == 'goal':
            place = heard.message.pose.position
            if (place.x, place.y) == self._place:
                self.accept(heard.at)
            elif self.task.accepted and not self._reached():
                self.task.end(Outcome.CANCELLED, f'it has another goal: {self._told()}')
        if topic in {'goal', 'pose'} and self.task.accepted and self._reached():
            self.task.end(Outcome.SUCCEEDED, 'arrived')

    def _on_path(self, heard: Heard) -> None:
        """Take a path that leads there: as long as the tree rests, the one of before is told."""
        points = points_of(heard.message)
        if points and dist(points[-1], self._place) < SAME_PLACE:
            super()._on_path(heard)

    def accept(self, now: float) -> None:
        """Be taken; the same goal told again is no other one."""
        if not self.task.accepted:
            super().accept(now)

    def distance_left(self) -> float:
        """Return the way that is left along the path to the place [m]."""
        left = super().distance_left()
        return left if isfinite(left) else self._straight()

    def _straight(self) -> float:
        pose = self._view.pose_in('map')
        return nan if pose is None else dist(pose[:2], self._place)

    def _reached(self) -> bool:
        return self._straight() < self._arrival

    def _told(self) -> str:
        return self._view.state(self.driver)
