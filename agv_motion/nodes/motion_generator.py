"""Node `motion_generator`: sap flow and pose in, the twist of the tree out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, Vector3Stamped
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

from agv_motion.activity import Activity, Cause, Doing
from agv_motion.motion.behavior.agent import Agent
from agv_motion.nodes.blocked_report import BlockedReport
from agv_motion.nodes.motion_inputs import MotionInputs
from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
from agv_motion.nodes.motion_report import MotionReport, missing
from agv_motion.nodes.reservation_exchange import ReservationExchange
from agv_motion.nodes.tree_agent import TreeAgent
from agv_motion.nodes.tree_command import TreeCommand
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.messages import pose_of, require_frame
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import COMMAND, LATCHED, SENSOR
from agv_motion.ros.run import run

if TYPE_CHECKING:
    from agv_motion.ros.port import Port


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
        agent = Agent(given.planner(), given.agent())
        name = given.tree_name or port.namespace.strip('/')
        exchange = ReservationExchange(port, agent, given, name) if given.share_zone else None
        self._tree = TreeAgent(port, given, agent, exchange)
        self._paused = False
        self._guard = BlockedReport(port, given.blocked, given.rim, RELEASE, 2.0 / given.rate)
        self._obstacle: Doing | None = None
        self._inputs = MotionInputs(port, given)
        self._command = TreeCommand(port, given)
        self._report = MotionReport(port, given.map_frame)
        port.listen(Vector3Stamped, 'granier/sap_flow', self._on_sap_flow, SENSOR, sole=True)
        port.listen(Bool, 'granier/valid', self._on_valid, LATCHED)
        port.listen(PoseWithCovarianceStamped, 'pose', self._on_pose, SENSOR, sole=True)
        port.need('granier/sap_flow', 'pose')
        port.listen(PoseStamped, 'goal_pose', self._on_goal, COMMAND)
        port.serve(SetBool, '~/pause', self._on_pause)
        port.serve(Trigger, '~/next_goal', self._on_next_goal)
        port.serve(Trigger, '~/go_home', self._on_go_home)
        port.every(1.0 / given.rate, self._tick)
        port.watch_inputs(given.stop_after, self._watch)

    def begin(self) -> None:
        """Know nothing of before; tell where the tree means to go, and what it remembers."""
        self._inputs.begin()
        self._command.begin(self.port.seconds())
        self._guard.release()
        self._judge()
        self._publish_goal()
        self._tree.begin()

    def halt(self) -> None:
        """Send the last word: no motion; then keep what is remembered."""
        self._stop(Doing('stopped', Activity.STOPPED, Cause.PERSON))
        self._tree.end(self._inputs.pose)

    def accept(self, parameters: MotionGeneratorParameters) -> None:
        """Take over new thresholds and hours, a rest until a time, and another zone."""
        before = self.parameters
        parameters.require_to_come(before, self.port.seconds())
        if parameters.zone != before.zone:
            self._tree.move_to_zone(parameters, self._inputs.pose_now)
            self._report.publish_goal(self._tree.agent.goal, ())
        self._tree.agent.retune(parameters.agent())
        self._tree.reconsider()

    def diagnose(self) -> Diagnosis:
        """Tell what the tree does, why, and what it misses."""
        hour = self._tree.agent.hour_now(self.port.seconds())
        values = self._report.values(hour, self.parameters.schedule.time_zone)
        values['limits in force'] = ', '.join(self._command.limited_by) or 'none'
        values |= self._tree.values()
        if self._guard.reason:
            return Diagnosis(ERROR, self._report.state, values)
        worried = self._inputs.watches.lost or self._tree.alarmed
        return Diagnosis(WARN if worried else OK, self._report.state, values)

    def _on_sap_flow(self, message: Vector3Stamped) -> None:
        if not self._inputs.take_flow(message):
            return
        self._tree.reconsider()
        if self._obstacle:
            self._judge()
        self._move()

    def _on_valid(self, message: Bool) -> None:
        self._inputs.valid = message.data
        if not message.data:
            self._judge()
            self._move()

    def _on_pose(self, message: PoseWithCovarianceStamped) -> None:
        if self._inputs.take_pose(message):
            self._tree.reconsider()
            self._judge()

    def _on_goal(self, message: PoseStamped) -> None:
        require_frame(message.header.frame_id, self.parameters.map_frame)
        goal = pose_of(message.pose)
        self._tree.agent.set_goal(goal.x, goal.y, 'asked for')
        self._go_on()
        self._publish_goal()

    def _on_pause(self, request: Any) -> str:
        self._paused = request.data
        if not self._paused:
            self._guard.release()
        self._judge()
        self._move()
        return 'paused' if self._paused else 'going on'

    def _on_next_goal(self, _: Any) -> str:
        self._tree.agent.next_goal()
        self._go_on()
        self._move()
        goal = self._tree.agent.goal
        return goal.reason if goal else f'chosen later; {self._report.state}'

    def _on_go_home(self, _: Any) -> str:
        self._tree.agent.go_home()
        self._go_on()
        self._move()
        return self._report.state

    def _go_on(self) -> None:
        """Let a blocked tree try again, and decide anew: a person wants it elsewhere."""
        self._guard.release()
        self._judge()
        self._tree.reconsider()

    def _tick(self) -> None:
        """Keep the command alive, unless the tree does not move though it is told to."""
        inputs = self._inputs
        pose = None if inputs.watches.lost else inputs.pose
        self._guard.look(self.parameters.blocked, pose, self._command.twist)
        self._judge()
        self._move()

    def _watch(self) -> None:
        """Judge the silence of both inputs; stop at once, as a clock that stands ticks no more."""
        if self._inputs.watches.look():
            self._tick()
        self._tree.show_memory()

    def _judge(self) -> None:
        """Find out whether the tree may move; again whenever what it knows has changed."""
        self._obstacle = self._find_obstacle()

    def _find_obstacle(self) -> Doing | None:
        """Return what keeps the tree from moving now; None if nothing does."""
        if self._paused:
            return Doing('paused', Activity.PAUSED, Cause.PERSON)
        if obstacle := self._inputs.obstacle():
            return obstacle
        if self._guard.reason:
            return Doing(self._guard.reason, Activity.BLOCKED, Cause.MOTION)
        return None

    def _move(self) -> None:
        """Command what the sap flow asks for, or an explicit zero."""
        inputs, tree = self._inputs, self._tree
        pose, flow = inputs.pose, inputs.flow
        if self._obstacle or flow is None or pose is None:
            self._stop(self._obstacle or missing(pose, flow))
            tree.stay(pose, fresh=not inputs.watches.lost)
            return
        now = self.port.seconds()
        motion = tree.update(now, pose, flow)
        self._command.move(motion, now)
        doing = motion.doing
        if 'translation only' in self._command.limited_by:
            doing = doing._replace(state=f'{doing.state}; not turning: delicate floor')
        self._report.publish_state(doing)
        self._report.update(motion.goal, tree.agent.refusals, motion.path)

    def _stop(self, doing: Doing) -> None:
        """Command an explicit zero, and tell why."""
        self._command.stop()
        self._report.publish_state(doing)

    def _publish_goal(self) -> None:
        self._report.publish_goal(self._tree.agent.goal, self._tree.agent.refusals)


def main() -> None:
    """Run the node."""
    run(MotionGenerator)


if __name__ == '__main__':
    main()
