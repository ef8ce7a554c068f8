"""`agv demo trees`: several trees share a square, and keep clear of each other."""

from __future__ import annotations

import random
from math import pi
from typing import TYPE_CHECKING, Any, NamedTuple

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, Vector3Stamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from agv_motion.arbitration.source import TwistSource
from agv_motion.demo.arbitrated import TOPICS as ARBITER_TOPICS
from agv_motion.demo.arbitrated import arbiter_node, drives_as
from agv_motion.demo.configured import N, configured_node
from agv_motion.demo.drawn import TOPICS as DRAWN_TOPICS
from agv_motion.demo.drawn import model_node, scene_node
from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
from agv_motion.demo.scenario import DemoGraph, DemoSoFar, Scenario
from agv_motion.demo.trees_view import TreesView
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.report.recorded_footprint import read_footprints
from agv_motion.report.walks import RecordedWalk, nearest, read_walks, summary
from agv_motion.report.walks_figure import draw
from agv_motion.ros.config import find_config
from agv_motion.simulation.trials.crowd import scattered

if TYPE_CHECKING:
    import pathlib
    from collections.abc import Iterator

    from rich.console import RenderableType

    from agv_motion.bag.reader import BagReader
    from agv_motion.nodes.arbiter import ArbiterNode
    from agv_motion.nodes.robot_model import RobotModelNode
    from agv_motion.nodes.scene import Scene
    from agv_motion.ros.live_node import LiveNode

CONFIG = 'tree.yaml'
NAMES = ('oak', 'ash', 'elm', 'fir', 'yew')

OF_EACH = (
    ('granier/sap_flow', Vector3Stamped, False),
    ('granier/water_use_today', Vector3Stamped, False),
    *ARBITER_TOPICS,
    *DRAWN_TOPICS,
    ('goal', PoseStamped, True),
    ('state', String, True),
    ('path', Path, True),
    ('turrets/command', JointState, False),
    ('turrets/state', JointState, False),
    ('odom', Odometry, False),
    ('pose', PoseWithCovarianceStamped, False),
    ('ground_truth', Odometry, False),
)
"""Topics of each tree, their types, and whether they are latched."""

RATE = 5.0
"""[Hz] of steps and commands: a tree walks 3 mm in each, and several share one processor."""


class TreesScenario(Scenario[list[RecordedWalk]]):
    """Several trees in one zone, eight nodes each."""

    figure = 'trees.png'
    doing = 'walking'

    def __init__(
        self, seconds: float, count: int, zone: str, seed: int, time_factor: float
    ) -> None:
        """Let trees walk with the values of ``config/tree.yaml``.

        Args:
            seconds: How long, simulated [s].
            count: How many trees.
            zone: Zone file; empty for the square outdoors.
            seed: Of where the trees start, of weather and of noise.
            time_factor: Simulated seconds per second.

        """
        super().__init__(seconds)
        self._names = NAMES[:count]
        self._zone_file = zone or 'zone_outdoor.yaml'
        self._seed, self._time_factor = seed, time_factor

    def build(self) -> DemoGraph:
        """Make the nodes of all trees.

        Raises:
            GeometryError: So many trees do not fit into the zone.

        """
        names, zone, seed = self._names, self._zone_file, self._seed
        minds = [self._minds(names[0], seed)]
        given = minds[0].motion.parameters
        self._traffic = given.sharing()
        self._zone = load_zone(find_config(zone), given.rim)
        chance = random.Random(seed)  # noqa: S311 - a simulation, no secret
        starts = scattered(self._zone, len(names), self._traffic.clearance, chance)
        # those of the others take a second: not before it is known that they have room
        minds += [self._minds(name, seed + i) for i, name in enumerate(names) if i]
        simulators: list[LiveNode[Any]] = []
        for i, (name, (x, y)) in enumerate(zip(names, starts, strict=True)):
            start_at = {'start_x': x, 'start_y': y, 'start_heading': chance.uniform(-pi, pi)}
            clock = {'clock': 'follow' if i else 'lead', 'time_factor': self._time_factor}
            body = {'rate': RATE, 'seed': seed + i, **start_at, **clock}
            simulators.append(configured_node(Simulator, CONFIG, body, namespace=name))
        topics = [RecordedTopic(f'{name}/{t}', *rest) for name in names for t, *rest in OF_EACH]
        topics += [
            RecordedTopic('/reservations', MarkerArray),
            RecordedTopic('/diagnostics', DiagnosticArray),
        ]
        nodes = [*(node for mind in minds for node in mind), *simulators]
        return DemoGraph(nodes, simulators[0], topics)

    def _minds(self, name: str, seed: int) -> _Minds:
        """Return the nodes of the tree ``name``."""
        shared = {
            'rate': RATE, 'share_zone': True, 'zone_file': self._zone_file, 'goals__seed': seed,
            'traffic__expected': [other for other in self._names if other != name],
        }  # fmt: skip
        simulated = {'use_sim_time': True}

        def node(kind: type[N], changes: dict[str, Any], **kwargs: Any) -> LiveNode[N]:
            return configured_node(kind, CONFIG, simulated | changes, namespace=name, **kwargs)

        return _Minds(
            node(GranierProbe, {'simulated__seed': seed}),
            node(MotionGenerator, shared, **drives_as(TwistSource.AGENT)),
            arbiter_node(CONFIG, {'rate': RATE}, name),
            node(WheelKinematics, {'rate': RATE}),
            node(Localization, {}),
            model_node(CONFIG, name),
            scene_node(CONFIG, name),
        )

    def view(self, recorder: DemoRecorder) -> TreesView:
        """Show zone and trails, and what each tree does."""
        return TreesView(recorder, self._zone, self._names)

    def read(self, bag: BagReader) -> list[RecordedWalk]:
        """Read the walks back."""
        walks = read_walks(bag, self._names)
        begin = bag.start * 1e-9
        ends = [(begin + walk.time[[0, -1]]).tolist() if len(walk.time) else [] for walk in walks]
        return [
            walk._replace(footprints=read_footprints(bag, f'/{walk.name}/ground_truth', stamps))
            for walk, stamps in zip(walks, ends, strict=True)
        ]

    def tell(self, run: list[RecordedWalk], _: DemoSoFar) -> Iterator[RenderableType]:
        """Yield the figures of the walks."""
        if not _all_told(run):
            yield 'Ended before every tree had told where it is.'
            return
        yield summary(run)
        yield nearest(run, self._traffic)

    def draw(self, run: list[RecordedWalk], path: pathlib.Path) -> bool:
        """Draw the walks, if every tree has one."""
        if _all_told(run):
            draw(run, self._zone, self._traffic, path)
        return _all_told(run)


def _all_told(walks: list[RecordedWalk]) -> bool:
    """Return whether of every tree is known where it was."""
    return all(len(walk.time) for walk in walks)


class _Minds(NamedTuple):
    """All nodes of one tree but its simulator."""

    probe: LiveNode[GranierProbe]
    motion: LiveNode[MotionGenerator]
    arbiter: LiveNode[ArbiterNode]
    wheels: LiveNode[WheelKinematics]
    localization: LiveNode[Localization]
    model: LiveNode[RobotModelNode]
    scene: LiveNode[Scene]
