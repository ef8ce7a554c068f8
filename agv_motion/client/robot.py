"""A robot as a script sees it: orders that return at once, and questions how it goes."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from geometry_msgs.msg import TwistStamped
from std_srvs.srv import SetBool

from agv_motion.client.dispatch import Dispatch, require
from agv_motion.client.drivers import STOPS, TREE
from agv_motion.client.link import ScriptLink
from agv_motion.client.order import Patience
from agv_motion.client.orders import Orders
from agv_motion.client.task import Feedback, Outcome, Result
from agv_motion.errors import AgvMotionError, SourceError
from agv_motion.planar import require_finite

if TYPE_CHECKING:
    from typing_extensions import Self

    from agv_motion.client.task import Fault
    from agv_motion.client.view import RobotView
    from agv_motion.planar import Pose, Twist

SETTLE = 0.3
"""[s] in which what was latched before comes in"""


class Robot(Orders):
    """One robot on the graph. Metres, radians, seconds; the frame in which its nodes drive.

    An order (`go_to`, `follow_route`, `drive_arc`, `spin`, `perform`) returns when the robot has
    taken it, and raises an `AgvMotionError` that says why if it has not; then `is_done`,
    `feedback`, `wait` and `result` tell how it goes. A new order takes the place of the last one.
    """

    def __init__(
        self, namespace: str = '', *, patience: float = 5.0, silent_after: float = 10.0,
        stands_for: float = 60.0, domain: int | None = None,
    ) -> None:  # fmt: skip
        """Find the robot.

        Args:
            namespace: Of the robot, such as ``/oak``; empty for none.
            patience: How long to wait for it to be found, and for each answer [s].
            silent_after: Silence of the robot after which an order has failed [s].
            stands_for: How long it may stand before an order has failed [s].
            domain: ROS domain; None: that of the environment.

        Raises:
            SourceError: No robot is there.
            SignalError: A limit is not finite.

        """
        require_finite('patience, silent_after, stands_for', (patience, silent_after, stands_for))
        self._stopped_by: list[str] = []
        self._link = link = ScriptLink(namespace, domain)
        link.speak(TwistStamped, 'cmd_vel/stop')
        link.know(SetBool, STOPS)
        super().__init__(Dispatch(link, Patience(patience, silent_after, stands_for)))
        try:
            _find(link, self._dispatch.view, patience)
        except BaseException:
            link.close()
            raise

    # How it goes

    def is_done(self) -> bool:
        """Return whether the order is over: done, failed or cancelled."""
        return self.result().outcome is not Outcome.RUNNING

    def result(self) -> Result:
        """Return how the order ended, with the reason; `Outcome.RUNNING` as long as it has not."""
        return self._dispatch.result()

    @property
    def fault(self) -> Fault:
        """What has failed the order, for programs."""
        return self._dispatch.fault()

    def pose(self, frame: str = '') -> Pose | None:
        """Return where the robot is in a frame, by its wheels if none is named; None: unknown."""
        view = self._dispatch.view
        with self._link.news:
            return view.pose_in(frame) if frame else view.odometry

    def twist(self) -> Twist | None:
        """Return how fast its wheels carry it; None as long as they have not told."""
        with self._link.news:
            return self._dispatch.view.twist

    def feedback(self) -> Feedback:
        """Return what the robot does, how far it has to go, and why it stands, if it does."""
        return self._dispatch.feedback()

    def wait(self, seconds: float) -> Result:
        """Wait until the order is over, at most so long [s]; nothing is cancelled by that."""
        require_finite('wait (seconds)', (seconds,))
        self._link.wait(self.is_done, seconds)
        return self.result()

    # Ends

    def cancel(self, seconds: float = 10.0) -> Result:
        """Take the order back: brake to rest, with explicit zeros, and let others drive.

        A tree is paused: it walks by itself again after `resume`, or with the next order.

        Args:
            seconds: How long to wait until it stands [s].

        Raises:
            AgvMotionError: It does not answer; then `stop` is left.

        """
        self._dispatch.cancel()
        return self.wait(seconds)

    def resume(self) -> None:
        """Let a tree that was paused walk again.

        Raises:
            AgvMotionError: It is no tree, or does not answer.

        """
        require(self._dispatch.ask(self._dispatch.first(TREE).service, SetBool.Request(data=False)))

    def stop(self) -> None:
        """Hold the wheels at once, until `release`: STOP, above all who drive.

        Raises:
            SourceError: Nobody confirms it: go and press the switch.

        """
        self._link.speak(TwistStamped, 'cmd_vel/stop').publish(TwistStamped())
        self._stopped_by = []
        for service in STOPS:
            if self._link.has(service) and not self._stopped_by:
                with suppress(AgvMotionError):
                    require(self._dispatch.ask(service, SetBool.Request(data=True)))
                    self._stopped_by.append(service)
        self._dispatch.give_up('STOP: asked for by this script')
        if not self._stopped_by:
            msg = (
                'nobody confirms the STOP: neither arbiter nor kinematics answer; press the switch'
            )
            raise SourceError(msg)

    def release(self) -> None:
        """Release a STOP, whoever asked for it. Nothing moves until somebody drives anew.

        Raises:
            AgvMotionError: Nobody there can.

        """
        services = self._stopped_by or STOPS
        there = [service for service in services if self._link.has(service)]
        if not there:
            msg = 'neither an arbiter nor kinematics is there, so nothing can be released'
            raise SourceError(msg)
        require(self._dispatch.ask(there[0], SetBool.Request(data=False)))
        self._stopped_by = []
        if not self._dispatch.wait_for_release():
            msg = f'it was released, but STOP holds again: {self._dispatch.view.stop}'
            raise SourceError(msg)

    def close(self) -> None:
        """Leave the graph; an order under way is taken back first, so that nothing drives alone."""
        try:
            if not self.is_done():
                self.cancel()
        except AgvMotionError:
            pass  # it does not answer: it is told when it does, and stands by its own watchdogs
        finally:
            self._link.close()

    def __enter__(self) -> Self:
        """Return the robot."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close it."""
        self.close()


def _find(link: ScriptLink, view: RobotView, patience: float) -> None:
    """Wait until a robot is heard.

    Raises:
        SourceError: It is not.

    """
    if not link.wait(lambda: view.is_there, patience):
        node = link.node
        space = node.get_namespace()
        others = {s for n, s in node.get_node_names_and_namespaces() if n == 'arbiter'}
        there = f'; there are {", ".join(sorted(others - {space}))}' if others else ''
        msg = (
            f"no robot in the namespace '{space}' within {patience:g} s: start it "
            f'(agv up), or name its namespace and ROS domain{there}'
        )
        raise SourceError(msg)
    link.wait(lambda: False, SETTLE)
