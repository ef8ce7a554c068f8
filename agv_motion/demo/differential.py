"""`agv demo differential`: a differential drive that performs a sequence of actions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, String

from agv_motion.arbitration.source import TwistSource
from agv_motion.demo.arbitrated import TOPICS as ARBITER_TOPICS
from agv_motion.demo.arbitrated import arbiter_node, drives_as
from agv_motion.demo.configured import configured_node
from agv_motion.demo.drawn import TOPICS as DRAWN_TOPICS
from agv_motion.demo.drawn import model_node, scene_node
from agv_motion.demo.drive_view import DriveView
from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
from agv_motion.demo.scenario import DemoGraph, DemoSoFar, Scenario
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.differential_simulator import DifferentialSimulator
from agv_motion.nodes.sequence import SequenceNode
from agv_motion.report.run import RunBag, read_run
from agv_motion.report.run_figure import draw
from agv_motion.sequence.runner import ENDS, SequenceState

if TYPE_CHECKING:
    import pathlib
    from collections.abc import Callable, Iterator

    from rich.console import RenderableType

    from agv_motion.bag.reader import BagReader
    from agv_motion.sequence.runner import Status

CONFIG = 'differential.yaml'

TOPICS = [
    *ARBITER_TOPICS,
    *DRAWN_TOPICS,
    RecordedTopic('wheels/command', JointState),
    RecordedTopic('wheels/state', JointState),
    RecordedTopic('odom', Odometry),
    RecordedTopic('fix', PoseWithCovarianceStamped),
    RecordedTopic('ground_truth', Odometry),
    RecordedTopic('sequence/path', Path, latched=True),
    RecordedTopic('sequence/progress', Float64),
    RecordedTopic('sequence/state', String, latched=True),
]


class DifferentialScenario(Scenario[RunBag]):
    """Robot, wheels and a sequence; it lasts until the sequence ends."""

    figure = 'run.png'
    doing = 'driving'

    def __init__(self, sequence: str, seed: int, time_factor: float) -> None:
        """Let the robot perform a sequence with the values of ``config/differential.yaml``.

        Args:
            sequence: File of the actions.
            seed: Of slip and noise.
            time_factor: Simulated seconds per second.

        """
        super().__init__()
        self._sequence, self._seed, self._time_factor = sequence, seed, time_factor
        self._status: Status | None = None

    def build(self) -> DemoGraph:
        """Make the six nodes."""
        patient = {'use_sim_time': True, 'report_after': 1.0, 'stop_after': 2.0}
        robot = configured_node(
            DifferentialSimulator, CONFIG, {'time_factor': self._time_factor, 'seed': self._seed}
        )
        self._actions = configured_node(
            SequenceNode, CONFIG, patient | {'file': self._sequence, 'autorun': True},
            cli_args=[*drives_as(TwistSource.SEQUENCE)['cli_args'], '-r', 'pose:=fix'],
        )  # fmt: skip
        wheels = configured_node(DifferentialKinematics, CONFIG, patient)
        arbiter = arbiter_node(CONFIG, {'timeouts__sequence': 2.0})
        model = model_node(CONFIG, pose='fix')
        seen = 'pose:=fix', 'path:=sequence/path', 'state:=sequence/state'
        scene = scene_node(CONFIG, '', *seen)
        return DemoGraph((self._actions, arbiter, wheels, model, scene, robot), robot, TOPICS)

    def progress(self, _: float) -> tuple[float, str]:
        """Return how much of the sequence is done, and the action."""
        return self._actions.plain.share_done(), self._actions.plain.told

    def view(self, recorder: DemoRecorder) -> DriveView:
        """Show where the robot is and how fast it drives."""
        return DriveView(recorder, {'odom': 'odom', 'truth': 'ground_truth'}, 'sequence/state')

    def over(self, _: float, __: Callable[[str], None]) -> bool:
        """Return whether the sequence has ended, or will never begin."""
        actions = self._actions.plain
        if actions.runner is not None:
            self._status = actions.runner.status
        ended = self._status is not None and self._status.state in ENDS
        return ended or bool(actions.refusal)

    @property
    def succeeded(self) -> bool:
        """Whether all actions were performed."""
        return self._status is not None and self._status.state is SequenceState.DONE

    def last_word(self, demo: DemoSoFar) -> str:
        """Return why it ended, and where."""
        last = demo.recorder.latest('ground_truth')
        if last is None:
            return 'interrupted before anything moved'
        place, reason = last.pose.pose.position, self._status.reason if self._status else ''
        why = self._actions.plain.refusal or reason or 'interrupted'
        return (
            f'{"done" if self.succeeded else why}: ends at {place.x:.3f} m, {place.y:.3f} m '
            f'after {demo.elapsed:.1f} s'
        )

    def read(self, bag: BagReader) -> RunBag:
        """Read the run back."""
        return read_run(bag)

    def tell(self, _: RunBag, __: DemoSoFar) -> Iterator[RenderableType]:
        """Yield nothing: the last word has told it."""
        yield from ()

    def draw(self, run: RunBag, path: pathlib.Path) -> bool:
        """Draw what was planned and what was driven."""
        draw(run, None, path)
        return True
