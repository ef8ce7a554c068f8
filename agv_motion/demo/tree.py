"""`agv demo`: the whole tree, sixty times faster than life."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, Vector3Stamped
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from sensor_msgs.msg import Illuminance, JointState, Temperature
from std_msgs.msg import Bool, Float64, String

from agv_motion.arbitration.source import TwistSource
from agv_motion.demo.arbitrated import TOPICS as ARBITER_TOPICS
from agv_motion.demo.arbitrated import arbiter_node, drives_as
from agv_motion.demo.configured import configured_node
from agv_motion.demo.drawn import TOPICS as DRAWN_TOPICS
from agv_motion.demo.drawn import model_node, scene_node
from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
from agv_motion.demo.scenario import DemoGraph, DemoSoFar, Scenario
from agv_motion.demo.tree_view import TreeView
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.report.walk import WalkOutcome, WalkRun, read_walk, summary
from agv_motion.report.walk_figure import WalkLimits, draw
from agv_motion.ros.config import find_config

if TYPE_CHECKING:
    import pathlib
    from collections.abc import Iterator

    from numpy.typing import NDArray
    from rich.console import RenderableType

    from agv_motion.bag.reader import BagReader

CONFIG = 'tree.yaml'

DAY = 86400.0
"""[s]"""

TOPICS = [
    *(RecordedTopic(f'granier/probe_{i}/temperature_difference', Temperature) for i in (1, 2, 3)),
    RecordedTopic('granier/sap_flow', Vector3Stamped),
    RecordedTopic('granier/water_use', Vector3Stamped),
    RecordedTopic('granier/water_use_today', Vector3Stamped),
    RecordedTopic('granier/valid', Bool, latched=True),
    RecordedTopic('granier/state', String, latched=True),
    *ARBITER_TOPICS,
    *DRAWN_TOPICS,
    RecordedTopic('goal', PoseStamped, latched=True),
    RecordedTopic('state', String, latched=True),
    RecordedTopic('path', Path, latched=True),
    RecordedTopic('memory/sap_flow', OccupancyGrid, latched=True),
    RecordedTopic('memory/last_visit', OccupancyGrid, latched=True),
    RecordedTopic('turrets/command', JointState),
    RecordedTopic('turrets/state', JointState),
    RecordedTopic('turrets/residual', Float64),
    RecordedTopic('odom', Odometry),
    RecordedTopic('ground_truth', Odometry),
    RecordedTopic('fix', PoseWithCovarianceStamped),
    RecordedTopic('pose', PoseWithCovarianceStamped),
    RecordedTopic('sunlight', Illuminance),
    RecordedTopic('/diagnostics', DiagnosticArray),
]


class TreeScenario(Scenario[WalkRun]):
    """One tree with its eight nodes, on simulated probes or on a recording."""

    figure = 'walk.png'
    doing = 'walking'

    def __init__(
        self, seconds: float, probes: dict[str, Any], zone: str, seed: int, time_factor: float
    ) -> None:
        """Let a tree walk with the values of ``config/tree.yaml``.

        Args:
            seconds: How long, simulated [s].
            probes: Parameters of `granier_probe` beside those.
            zone: Zone file; empty for that of the configuration.
            seed: Of all noise.
            time_factor: Simulated seconds per second.

        """
        super().__init__(seconds)
        self._probes, self._seed, self._time_factor = probes, seed, time_factor
        self._place = {'zone_file': zone} if zone else {}

    def build(self) -> DemoGraph:
        """Make the eight nodes; the tree starts at the home of its zone."""
        common = {'use_sim_time': True}
        probe = configured_node(GranierProbe, CONFIG, common | self._probes)
        self._drinks = probe.parameters.water.sapwood_area > 0.0
        motion = configured_node(
            MotionGenerator, CONFIG, common | self._place | {'goals__seed': self._seed},
            **drives_as(TwistSource.AGENT),
        )  # fmt: skip
        self._zone = load_zone(find_config(motion.parameters.zone_file), motion.parameters.rim)
        arbiter = arbiter_node(CONFIG, {})
        wheels = configured_node(WheelKinematics, CONFIG, common)
        localization = configured_node(Localization, CONFIG, common)
        x, y = self._zone.home or (0.0, 0.0)
        self._simulator = configured_node(
            Simulator, CONFIG,
            {'time_factor': self._time_factor, 'seed': self._seed, 'start_x': x, 'start_y': y},
        )  # fmt: skip
        self._wheels = wheels.parameters
        model, scene = model_node(CONFIG), scene_node(CONFIG)
        nodes = probe, motion, arbiter, wheels, localization, model, scene, self._simulator
        return DemoGraph(nodes, self._simulator, TOPICS)

    def view(self, recorder: DemoRecorder) -> TreeView:
        """Show zone, trail, probes and turrets."""
        return TreeView(recorder, self._zone, self._simulator.parameters, drinks=self._drinks)

    def read(self, bag: BagReader) -> WalkRun:
        """Read the walk back."""
        return read_walk(bag, self._wheels.wheel_radius)

    def tell(self, run: WalkRun, demo: DemoSoFar) -> Iterator[RenderableType]:
        """Yield the figures of the walk."""
        wheels, recorder = self._wheels, demo.recorder
        latencies = _latencies(recorder.arrivals)
        outcome = WalkOutcome(demo.elapsed, demo.factor, latencies, recorder.counts)
        yield summary(run, outcome, self._zone, wheels.max_wheel_speed, wheels.rim)

    def _days(self) -> float:
        """Return how many days of a recording are played; 0 on simulated probes."""
        return float(self._probes.get('csv__speed', 0.0)) * self.seconds / DAY

    def draw(self, run: WalkRun, path: pathlib.Path) -> bool:
        """Draw the walk."""
        wheels = self._wheels
        limits = WalkLimits(wheels.max_wheel_speed, wheels.residual_stop, wheels.rim)
        draw(run, self._zone, limits, path, days=self._days())
        return True


def _latencies(arrivals: dict[str, list[int]]) -> NDArray[np.float64]:
    """Return the times from a sap flow to the turret command that follows it [s]."""
    flows, commands = (
        np.array(arrivals[topic], dtype=float) for topic in ('granier/sap_flow', 'turrets/command')
    )
    after = np.searchsorted(commands, flows)
    known = after < len(commands)
    latencies: NDArray[np.float64] = (commands[after[known]] - flows[known]) * 1e-9
    return latencies
