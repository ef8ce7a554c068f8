"""Orders on their way: to the node that can carry them out, until it has taken or refused them."""

from __future__ import annotations

import time
from math import nan
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.parameter import Parameter
from std_srvs.srv import SetBool, Trigger

from agv_motion.client.drivers import DRIVERS, SEQUENCE, TREE, Driver
from agv_motion.client.order import Order, Patience, SequenceOrder, TreeGoal, TreeOrder
from agv_motion.client.task import Fault, Feedback, Outcome, Result
from agv_motion.client.view import RobotView
from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.planar import Pose
from agv_motion.ros.messages import fill_pose
from agv_motion.ros.remote_services import UnansweredError

if TYPE_CHECKING:
    from agv_motion.client.link import Heard, ScriptLink

NOTHING = Result(Outcome.FAILED, 'nothing was ordered')


def require(answer: Any) -> None:
    """Raise unless a service did what it was asked for.

    Raises:
        ConfigurationError: It did not; the message is its own.

    """
    if not answer.success:
        raise ConfigurationError(answer.message or 'refused without a reason')


class Dispatch:
    """Sends orders of one robot, one at a time, and judges the one under way."""

    def __init__(self, link: ScriptLink, patience: Patience) -> None:
        """Open what is needed, and listen.

        Args:
            link: To the graph; not started yet.
            patience: How long to wait.

        """
        self._link, self._patience = link, patience
        self._order: Order | None = None
        self._candidate: Order | None = None
        self._forsaken: Order | None = None
        """that nobody has answered in time: its node must not set off later"""
        for driver in DRIVERS:
            link.know(driver.kind, [driver.service])
        link.know(Trigger, ['sequence/start'])
        link.know(SetParameters, ['sequence/set_parameters'])
        link.know(GetParameters, ['motion_generator/get_parameters'])
        self.view = RobotView(link, self._receive)
        """What is heard of the robot"""
        link.start(self._look)

    def first(self, *drivers: Driver) -> Driver:
        """Return the first of some nodes that is there.

        Raises:
            SourceError: None is.

        """

        def there() -> list[Driver]:
            return [one for one in drivers if self._link.has(one.service)]

        if not self._link.wait(lambda: bool(there()), self._patience.answer):
            names = ' or '.join(one.node for one in drivers)
            msg = f'the robot has no node that does that: start {names} (agv run), and activate it'
            raise SourceError(msg)
        return there()[0]

    def ask(self, service: str, request: Any) -> Any:
        """Return the response of a service, waited for with patience."""
        return self._link.ask(service, request, self._patience.answer)

    # Orders

    def send(self, driver: Driver, topic: str, message: Any) -> None:
        """Publish an order, and wait until its node has taken it.

        Raises:
            AgvMotionError: It has not; the message says why.

        """
        node, known = driver.node, self.view.clock_of
        self._link.wait(lambda: known(node) is not None, self._patience.answer)
        self._publish(Order(driver, self.view, self._patience, time.monotonic()), topic, message)

    def send_tree(self, x: float, y: float, heading: float | None, frame: str) -> None:
        """Send a tree to (x, y) [m] in the map, and let it walk, if it was paused.

        Raises:
            AgvMotionError: It has not taken the order; the message says why.

        """
        if heading is not None:
            msg = f'heading = {heading:g}: a tree turns as its sap flows; give x and y only'
            raise ConfigurationError(msg)
        if frame.lstrip('/') not in {'', 'map'}:
            msg = f"frame '{frame}': a tree walks in 'map'"
            raise ConfigurationError(msg)
        request = GetParameters.Request(names=['rest.arrival'])
        (arrival,) = self.ask('motion_generator/get_parameters', request).values
        order = TreeOrder(
            TreeGoal((x, y), arrival.double_value), self.view, self._patience, time.monotonic()
        )
        require(self.ask(TREE.service, SetBool.Request(data=False)))
        goal = PoseStamped()
        goal.header.frame_id = 'map'
        fill_pose(goal.pose, Pose(x, y, 0.0))
        self._publish(order, 'goal_pose', goal)

    def send_sequence(self, file: str) -> None:
        """Start a sequence of a file.

        Raises:
            AgvMotionError: It was not taken; the message says why.

        """
        driver = self.first(SEQUENCE)
        self._require_free()
        request = SetParameters.Request()
        request.parameters = [Parameter('file', value=file).to_parameter_msg()]
        (taken,) = self.ask('sequence/set_parameters', request).results
        if not taken.successful:
            raise ConfigurationError(taken.reason)
        order = SequenceOrder(driver, self.view, self._patience, time.monotonic())
        self._begin(order)
        try:
            require(self.ask('sequence/start', Trigger.Request()))
            with self._link.news:
                order.accept(time.monotonic())
                self._order = order
        except UnansweredError:
            self._forsake(order)
            raise
        finally:
            self._candidate = None

    def set_pose(self, pose: Pose) -> None:
        """Tell the localization where the robot is, and wait until it says so, too.

        Raises:
            SourceError: There is none, or it does not.

        """
        message = PoseWithCovarianceStamped()
        message.header.frame_id = 'map'
        fill_pose(message.pose.pose, pose)
        self._link.publish('initialpose', message, self._patience.answer)
        for _ in range(2):  # who drives has heard the first when the second has come
            told = self.view.poses_told
            if not self._link.wait(lambda told=told: self.view.poses_told > told,  # type: ignore[misc]
                                   self._patience.answer):  # fmt: skip
                msg = f'localization tells no pose within {self._patience.answer:g} s: look at it'
                raise SourceError(msg)

    def _publish(self, order: Order, topic: str, message: Any) -> None:
        self._require_free()
        node = order.driver.node
        with self._link.news:
            before, _ = self.view.refusals(node)
        self._begin(order)

        def answered() -> bool:
            return order.task.accepted or self.view.refusals(node)[0] > before

        try:
            self._link.publish(topic, message, self._patience.answer)
            self._link.wait(answered, self._patience.answer)
            with self._link.news:
                count, reason = self.view.refusals(node)
                if not order.task.accepted and count > before:
                    raise ConfigurationError(reason)
                said = self.view.state(order.driver) or 'nothing'
                if order.task.accepted:
                    self._order = order
            if not order.task.accepted:
                self._forsake(order)
                msg = f'{node} does not answer; it says: {said}; it is told to leave the order'
                raise SourceError(msg)
        finally:
            self._candidate = None

    def _begin(self, order: Order) -> None:
        """Let an order hear; the last one stays in force until this one is taken."""
        with self._link.news:
            self._candidate, self._forsaken = order, None

    def _forsake(self, order: Order) -> None:
        """Let an order go that its node may hear yet: nobody would watch how it goes."""
        with self._link.news:
            self._candidate, self._forsaken = None, order
        self._take_back(order)

    def _require_free(self) -> None:
        """Raise if a STOP holds: an order would wait for whoever releases it.

        Raises:
            ConfigurationError: One does.

        """
        with self._link.news:
            stop = self.view.stop
        if stop:
            msg = f'STOP holds: {stop}; see that the way is free, and call release()'
            raise ConfigurationError(msg)

    # How it goes

    def result(self) -> Result:
        """Return how the last order ended, or that it has not."""
        with self._link.news:
            return NOTHING if self._order is None else self._order.task.result

    def fault(self) -> Fault:
        """Return what has failed the last order."""
        with self._link.news:
            return Fault.NONE if self._order is None else self._order.task.fault

    def feedback(self) -> Feedback:
        """Return how far the robot is."""
        with self._link.news:
            order, now = self._order, time.monotonic()
            if order is None:
                return Feedback(NOTHING.reason, nan, self.view.why(now))
            stands = order.stands(now) or bool(self.view.stop)
            why = self.view.why(now) if stands else ''
            if order.task.ended:
                why = order.task.result.reason
            return Feedback(self.view.state(order.driver), order.distance_left(), why)

    def cancel(self) -> None:
        """Ask the node to brake, and to end the order.

        Raises:
            AgvMotionError: It does not.

        """
        order = self._order
        if order is None or order.task.ended:
            return
        answer = self.ask(order.driver.service, order.driver.request)
        if not order.task.ended:
            require(answer)
        if order.driver is TREE:
            with self._link.news:
                order.task.end(Outcome.CANCELLED, 'paused')

    def give_up(self, reason: str) -> None:
        """Let the order have failed, and its node forget it, without waiting."""
        order = self._order
        if order is None or order.task.ended:
            return
        with self._link.news:
            order.task.end(Outcome.FAILED, reason, Fault.STOPPED)
        self._take_back(order)

    def wait_for_release(self) -> bool:
        """Return whether no STOP holds any more, waited for with patience."""
        return self._link.wait(lambda: not self.view.stop, self._patience.answer)

    def _receive(self, topic: str, heard: Heard) -> None:
        for order in (self._order, self._candidate, self._forsaken):
            if order is not None:
                order.receive(topic, heard)
        late = self._forsaken
        if late is not None and late.task.accepted:
            self._forsaken = None
            self._take_back(late)
        self._judge(heard.at)

    def _look(self, now: float) -> None:
        self._judge(now)

    def _judge(self, now: float) -> None:
        """End an order that the robot cannot carry out, and take it back: it must not go later."""
        order = self._order
        if order is None or order.task.ended:
            return
        order.look(now)
        if order.task.result.outcome is Outcome.FAILED:
            self._take_back(order)

    def _take_back(self, order: Order) -> None:
        if order.driver is not TREE and self._link.has(order.driver.service):
            self._link.ask_only(order.driver.service, order.driver.request)
