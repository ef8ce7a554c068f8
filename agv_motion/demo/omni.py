"""`agv demo omni`: an omni robot that loses its way and finds it again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64

from agv_motion.demo.arbitrated import TOPICS as ARBITER_TOPICS
from agv_motion.demo.arbitrated import arbiter_node
from agv_motion.demo.configured import configured_node
from agv_motion.demo.drawn import TOPICS as DRAWN_TOPICS
from agv_motion.demo.drawn import model_node, scene_node
from agv_motion.demo.drive_view import DriveView
from agv_motion.demo.omni_driver import OmniDriver
from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
from agv_motion.demo.scenario import DemoGraph, DemoSoFar, Scenario
from agv_motion.model.footprint import footprint
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.omni_simulator import OmniSimulator
from agv_motion.planar import Pose
from agv_motion.report.localization import LocalizationRun, read_localization, summary
from agv_motion.report.localization_figure import draw

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from rich.console import RenderableType

    from agv_motion.bag.reader import BagReader

CONFIG = 'omni.yaml'

TOPICS = [
    *ARBITER_TOPICS,
    *DRAWN_TOPICS,
    RecordedTopic('wheels/command', JointState),
    RecordedTopic('wheels/state', JointState),
    RecordedTopic('wheels/free_speed', JointState),
    RecordedTopic('wheels/residual', Float64),
    RecordedTopic('imu', Imu),
    RecordedTopic('odom', Odometry),
    RecordedTopic('odom/filtered', Odometry),
    RecordedTopic('fix', PoseWithCovarianceStamped),
    RecordedTopic('pose', PoseWithCovarianceStamped),
    RecordedTopic('ground_truth', Odometry),
    RecordedTopic('/diagnostics', DiagnosticArray),
]

CARRIED = Pose(6.5, 5.0, -2.0)
"""Where the robot is set down when it is carried away."""

CARRIED_AFTER = 2.0 / 3.0
"""Share of the time after which that happens."""


class OmniScenario(Scenario[LocalizationRun]):
    """Robot, wheels, localization and a driver."""

    figure = 'path.png'
    doing = 'driving'

    def __init__(self, seconds: float, *, carry: bool, seed: int, time_factor: float) -> None:
        """Let the robot drive with the values of ``config/omni.yaml``.

        Args:
            seconds: How long, simulated [s].
            carry: Whether somebody carries it away on its way.
            seed: Of the way and of all noise.
            time_factor: Simulated seconds per second.

        """
        super().__init__(seconds)
        self._to_carry = carry
        self._seed, self._time_factor = seed, time_factor

    def build(self) -> DemoGraph:
        """Make the nodes and the driver."""
        common = {'use_sim_time': True}
        patient = common | {'report_after': 1.0, 'stop_after': 2.0}  # a busy machine runs late
        self._simulator = configured_node(
            OmniSimulator, CONFIG, {'time_factor': self._time_factor, 'seed': self._seed}
        )
        wheels = configured_node(OmniKinematics, CONFIG, patient)
        localization = configured_node(Localization, CONFIG, common)
        arbiter = arbiter_node(CONFIG, {'timeouts__agent': 2.0})
        model = model_node(CONFIG)
        self._model = model.parameters.model()
        nodes = (
            arbiter,
            wheels,
            localization,
            model,
            scene_node(CONFIG),
            self._simulator,
        )
        return DemoGraph(nodes, self._simulator, TOPICS, others=[OmniDriver(self._seed)])

    def view(self, recorder: DemoRecorder) -> DriveView:
        """Show where the robot is and how fast it drives."""
        return DriveView(recorder, {'pose': 'pose', 'truth': 'ground_truth'})

    def over(self, elapsed: float, say: Callable[[str], None]) -> bool:
        """Carry the robot away when it is time."""
        if self._to_carry and elapsed >= CARRIED_AFTER * self.seconds:
            self._to_carry = False
            say(f'{elapsed:.0f} s: somebody carries the robot away')
            self._simulator.plain.carry_to(CARRIED)
        return super().over(elapsed, say)

    def read(self, bag: BagReader) -> LocalizationRun:
        """Read the drive back."""
        return read_localization(bag)

    def tell(self, run: LocalizationRun, _: DemoSoFar) -> Iterator[RenderableType]:
        """Yield the figures of the drive."""
        yield summary(run)

    def draw(self, run: LocalizationRun, path: Path) -> bool:
        """Draw the drive."""
        draw(run, path, footprint(self._model, {}))
        return True
