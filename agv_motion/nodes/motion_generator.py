"""Node `motion_generator`: sap flow and pose in, the twist of the tree out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, Vector3Stamped
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

from agv_motion.activity import Activity, Cause, Doing
from agv_motion.motion.behavior.agent import Agent
from agv_motion.motion.behavior.sap_flow import SapFlow, checked_sap_flow
from agv_motion.motion.command.limits import CommandLimits, Limited
from agv_motion.motion.command.polar import to_twist
from agv_motion.motion.pilot import pilot_alone
from agv_motion.nodes.blocked_report import BlockedReport
from agv_motion.nodes.memory_store import MemoryStore
from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
from agv_motion.nodes.motion_report import MotionReport, missing
from agv_motion.nodes.reservation_exchange import ReservationExchange
from agv_motion.nodes.zone_report import ZoneReport, require_standing
from agv_motion.planar import REST, Pose
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.input_watches import InputWatches
from agv_motion.ros.messages import pose_of, require_frame
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import COMMAND, LATCHED, SENSOR
from agv_motion.ros.run import run
from agv_motion.ros.twist_rows import twist_publisher
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from agv_motion.motion.pilot import MotionCommand
    from agv_motion.ros.port import Port


DECIDE_PERIOD = 1.0
"""[s] after which the tree decides again though nothing is new: of the hour, and of other paths."""

FLOW, POSE = 'sap flow', 'pose'
"""The inputs without which the tree does not move."""

RELEASE = 'clear its way, then call ~/pause with data: false'
"""What a person does to let a blocked tree go on."""


class MotionGenerator(PlainNode[MotionGeneratorParameters]):
    """`granier/sap_flow`, `granier/valid` and `pose` -> `cmd_vel`, `goal`, `path` and `state`.

    Without a fresh and valid sap flow, or without a pose, the command is an explicit zero.
    """

    name = 'motion_generator'
    takes = MotionGeneratorParameters

    def __init__(self, port: Port, parameters: MotionGeneratorParameters) -> None:
        """Build the agent, give it back its memory, and open the topics."""
        super().__init__(port, parameters)
        given = parameters
        self._rim = given.rim
        self._agent = Agent(given.planner(), given.agent())
        self._pilot = pilot_alone(self._agent)
        self._exchange = self._join(given) if given.share_zone else None
        self._zone = ZoneReport(port, self._exchange.others if self._exchange else ())
        self._limits = CommandLimits.of(given.limits)
        self._sap_flow: SapFlow | None = None
        self._pose: Pose | None = None
        self._valid, self._paused = True, False
        self._motion: MotionCommand | None = None
        self._limited_by: tuple[str, ...] = ()
        self._commanded_at = self._looked_at = port.seconds()
        self._twist, self._decided_at = REST, 0.0
        self._guard = BlockedReport(port, given.blocked, self._rim, RELEASE)
        self._obstacle: Doing | None = None
        self._inputs = InputWatches(port, given.freshness(), (FLOW, POSE))
        self._command = twist_publisher(port, given.base_frame, stamped=given.stamped)
        self._report = MotionReport(port, given.map_frame)
        self._store = (
            None if self._agent.memory is None else MemoryStore(port, self._agent.memory, given)
        )
        port.listen(Vector3Stamped, 'granier/sap_flow', self._on_sap_flow, SENSOR, sole=True)
        port.listen(Bool, 'granier/valid', self._on_valid, LATCHED)
        port.listen(PoseWithCovarianceStamped, 'pose', self._on_pose, SENSOR, sole=True)
        port.listen(PoseStamped, 'goal_pose', self._on_goal, COMMAND)
        port.serve(SetBool, '~/pause', self._on_pause)
        port.serve(Trigger, '~/next_goal', self._on_next_goal)
        port.serve(Trigger, '~/go_home', self._on_go_home)
        port.every(1.0 / given.rate, self._tick)
        port.watch_inputs(given.stop_after, self._watch)

    def _join(self, given: MotionGeneratorParameters) -> ReservationExchange:
        name = given.tree_name or self.port.namespace.strip('/')
        return ReservationExchange(self.port, self._agent, given, name)

    def begin(self) -> None:
        """Know nothing of before; tell where the tree means to go, and what it remembers."""
        self._sap_flow = self._pose = self._motion = None
        self._commanded_at = self._looked_at = self.port.seconds()
        self._guard.release()
        self._inputs.wait_for(FLOW)
        self._judge()
        self._report.publish_goal(self._agent.goal, self._agent.refusals)
        self._zone.publish(self._agent.zone)
        if self._store is not None:
            self._store.begin()

    def halt(self) -> None:
        """Send the last word: no motion; then keep what is remembered."""
        self._publish(self._limits.stop(), Doing('stopped', Activity.STOPPED, Cause.PERSON))
        if self._exchange is not None and self._pose is not None:
            self._exchange.park(self._pose)
        if self._store is not None:
            self._store.save_at_last()

    def accept(self, parameters: MotionGeneratorParameters) -> None:
        """Take over new thresholds and hours, a rest until a time, and another zone."""
        before = self.parameters
        parameters.require_to_come(before, self.port.seconds())
        if parameters.zone != before.zone:
            self._move_to_zone(parameters)
        self._agent.retune(parameters.agent())
        self._motion = None

    def _move_to_zone(self, parameters: MotionGeneratorParameters) -> None:
        """Go on in another zone, if the tree stands in it as far as is known.

        Raises:
            AgvMotionError: It is none, or this tree or another stands outside of it.

        """
        lost = self._inputs[POSE].silence() is Silence.LOST
        pose, planner = None if lost else self._pose, parameters.planner(self._agent.home)
        here = require_standing(pose, planner, self._agent.zone)
        if self._exchange is not None:
            self._exchange.require_inside(here.planner.zone)
        agent = self._agent.moved_to(here.planner)
        if self._exchange is not None:
            self._exchange.move_to(agent, here.pose)
        self._agent, self._pilot = agent, pilot_alone(agent)
        if self._store is not None and agent.memory is not None:
            self._store.move_to(agent.memory)
        self._zone.publish(agent.zone)
        self._report.publish_goal(agent.goal, ())

    def diagnose(self) -> Diagnosis:
        """Tell what the tree does, why, and what it misses."""
        hour = self._agent.hour_now(self.port.seconds())
        values = self._report.values(hour, self.parameters.schedule.time_zone)
        values['limits in force'] = ', '.join(self._limited_by) or 'none'
        if self._agent.goal is not None:
            values['goal'] = self._agent.goal.reason
        values |= self._store.report() if self._store is not None else {}
        values |= self._exchange.report() if self._exchange is not None else {}
        if different := self._zone.different():
            values['zone differs from'] = ', '.join(different)
        alarmed = self._exchange is not None and self._exchange.alarm
        if self._guard.reason:
            return Diagnosis(ERROR, self._report.state, values)
        return Diagnosis(WARN if self._inputs.lost or alarmed else OK, self._report.state, values)

    def _on_sap_flow(self, message: Vector3Stamped) -> None:
        vector = message.vector
        flow = checked_sap_flow(SapFlow(vector.x, vector.y, vector.z))
        require_frame(self.parameters.own(message.header.frame_id), self.parameters.base_frame)
        if not self._inputs[FLOW].is_news(message.header.stamp):
            return
        self._inputs.note(FLOW)
        self._sap_flow = flow
        self._motion = None
        if self._obstacle:
            self._judge()
        self._move()

    def _on_valid(self, message: Bool) -> None:
        self._valid = message.data
        if not self._valid:
            self._judge()
            self._move()

    def _on_pose(self, message: PoseWithCovarianceStamped) -> None:
        require_frame(message.header.frame_id, self.parameters.map_frame)
        pose = pose_of(message.pose.pose)
        if not self._inputs[POSE].is_news(message.header.stamp):
            return
        self._inputs.note(POSE)
        self._pose = pose
        self._motion = None
        self._judge()

    def _on_goal(self, message: PoseStamped) -> None:
        require_frame(message.header.frame_id, self.parameters.map_frame)
        goal = pose_of(message.pose)
        self._agent.set_goal(goal.x, goal.y, 'asked for')
        self._guard.release()
        self._judge()
        self._motion = None
        self._report.publish_goal(self._agent.goal, self._agent.refusals)

    def _on_pause(self, request: Any) -> str:
        self._paused = request.data
        if not self._paused:
            self._guard.release()
        self._judge()
        self._move()
        return 'paused' if self._paused else 'going on'

    def _on_next_goal(self, _: Any) -> str:
        self._agent.next_goal()
        self._guard.release()
        self._judge()
        self._motion = None
        self._move()
        goal = self._agent.goal
        return goal.reason if goal else f'chosen later; {self._report.state}'

    def _on_go_home(self, _: Any) -> str:
        self._agent.go_home()
        self._guard.release()
        self._judge()
        self._motion = None
        self._move()
        return self._report.state

    def _tick(self) -> None:
        """Keep the command alive."""
        self._look_for_block()
        self._judge()
        self._move()

    def _look_for_block(self) -> None:
        """Find out whether the tree has moved as it was told."""
        given, now = self.parameters, self.port.seconds()
        dt = min(max(now - self._looked_at, 0.0), 2.0 / given.rate)
        self._looked_at = now
        self._guard.look(given.blocked, None if self._inputs.lost else self._pose, self._twist, dt)

    def _watch(self) -> None:
        """Judge the silence of both inputs; stop at once, as a clock that stands ticks no more."""
        if self._inputs.look():
            self._tick()
        if self._store is not None:
            self._store.publish_first()

    def _judge(self) -> None:
        """Find out whether the tree may move; again whenever what it knows has changed."""
        self._obstacle = self._find_obstacle()

    def _find_obstacle(self) -> Doing | None:
        """Return what keeps the tree from moving now; None if nothing does."""
        if self._paused:
            return Doing('paused', Activity.PAUSED, Cause.PERSON)
        if not self._valid:
            return Doing('resting: a probe cannot be believed', Activity.RESTING, Cause.PROBES)
        if self._inputs.lost or self._sap_flow is None or self._pose is None:
            return missing(self._pose, self._sap_flow, self._inputs.lost, self.port.clock.fault)
        if self._guard.reason:
            return Doing(self._guard.reason, Activity.BLOCKED, Cause.MOTION)
        return None

    def _move(self) -> None:
        """Command what the sap flow asks for, or an explicit zero."""
        if self._obstacle or self._sap_flow is None or self._pose is None:
            doing = self._obstacle or missing(self._pose, self._sap_flow)
            self._publish(self._limits.stop(), doing)
            if self._exchange is not None and self._pose is not None:
                self._exchange.stay(self._pose, fresh=not self._inputs.lost)
            return
        now = self.port.seconds()
        motion = self._update(now, self._pose, self._sap_flow)
        # after a hiccup the command goes on from where it was, as if no time had passed
        dt = min(max(now - self._commanded_at, 0.0), 2.0 / self.parameters.rate)
        self._publish(self._limits.apply(motion.wanted, motion.rules, dt), motion.doing)
        self._report.update(motion.goal, self._agent.refusals, motion.path)

    def _update(self, now: float, pose: Pose, flow: SapFlow) -> MotionCommand:
        """Decide when something is new; also now and then, and always where others walk."""
        if self._exchange is not None:
            return self._exchange.update(now, pose, flow)
        if self._motion is None or not 0.0 <= now - self._decided_at < DECIDE_PERIOD:
            self._motion, self._decided_at = self._pilot.update(now, pose, flow, now), now
        return self._motion

    def _publish(self, limited: Limited, doing: Doing) -> None:
        self._limited_by = limited.by
        self._twist = to_twist(limited.command, self.parameters.linear_speed, self._rim)
        # when it is said, not when the decision began: by their stamps the rates hold
        self._commanded_at = self._command(self._twist)
        if 'translation only' in limited.by:
            doing = doing._replace(state=f'{doing.state}; not turning: delicate floor')
        self._report.publish_state(doing)


def main() -> None:
    """Run the node."""
    run(MotionGenerator)


if __name__ == '__main__':
    main()
