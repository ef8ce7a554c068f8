"""The graph of several trees: the five nodes of each, and a recorder, on one executor."""

from __future__ import annotations

import random
import time
from math import pi
from typing import TYPE_CHECKING, Any, NamedTuple

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TwistStamped, Vector3Stamped
from nav_msgs.msg import Odometry, Path
from rclpy.signals import SignalHandlerOptions
from rich.console import Group
from rich.live import Live
from rich.progress import Progress
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from agv_motion.demo.configured import configured
from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
from agv_motion.demo.trees_view import TreesView
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.ros.config import find_config
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import spin, start
from agv_motion.ros.stop import Stop
from agv_motion.simulation.trials.crowd import scattered

if TYPE_CHECKING:
    import pathlib
    from collections.abc import Sequence

    from rich.console import Console


NAMES = ('oak', 'ash', 'elm', 'fir', 'yew')

OF_EACH = (
    ('granier/sap_flow', Vector3Stamped, False),
    ('cmd_vel', TwistStamped, False),
    ('goal', PoseStamped, True),
    ('state', String, True),
    ('path', Path, True),
    ('turrets/command', JointState, False),
    ('turrets/state', JointState, False),
    ('pose', PoseWithCovarianceStamped, False),
    ('ground_truth', Odometry, False),
)
"""Topics of each tree, their types, and whether they are latched."""

RATE = 5.0
"""[Hz] of steps and commands: a tree walks 3 mm in each, and several share one processor."""

REFRESH = 0.25
"""[s] between two pictures of the live view"""


class TreesGraph:
    """Builds the graph and runs it."""

    def __init__(
        self, count: int, zone: str, seed: int, time_factor: float, bag: pathlib.Path
    ) -> None:
        """Create and start the nodes of all trees with the values of ``config/tree.yaml``.

        Args:
            count: How many trees.
            zone: Zone file; empty for that of the configuration.
            seed: Of where the trees start, of weather and of noise.
            time_factor: Simulated seconds per second.
            bag: Folder of the new bag.

        Raises:
            GeometryError: So many trees do not fit into the zone.

        """
        rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
        self._stop = Stop()
        self.names = NAMES[:count]
        zone = zone or 'zone_outdoor.yaml'
        minds = [_minds(name, self.names, zone, seed + i) for i, name in enumerate(self.names)]
        given = minds[0].motion.parameters
        self.traffic = given.sharing()
        self.zone = load_zone(find_config(zone), given.rim)
        chance = random.Random(seed)  # noqa: S311 - a simulation, no secret
        starts = scattered(self.zone, count, self.traffic.clearance, chance)
        self._nodes: list[LiveNode[Any]] = []
        self._simulators: list[LiveNode[Simulator]] = []
        for i, (name, (x, y)) in enumerate(zip(self.names, starts, strict=True)):
            self._nodes += minds[i]
            start_at = {'start_x': x, 'start_y': y, 'start_heading': chance.uniform(-pi, pi)}
            clock = {'clock': 'follow' if i else 'lead', 'time_factor': time_factor}
            body = {'rate': RATE, 'seed': seed + i, **start_at, **clock}
            self._simulators.append(LiveNode(Simulator, **_given('simulator', name, body)))
        for node in (*self._nodes, *self._simulators):
            start(node)
        topics = [
            RecordedTopic(f'{name}/{t}', *rest) for name in self.names for t, *rest in OF_EACH
        ]
        topics += [
            RecordedTopic('/reservations', MarkerArray),
            RecordedTopic('/diagnostics', DiagnosticArray),
        ]
        self._leader = self._simulators[0].plain
        self._recorder = DemoRecorder(bag, topics, lambda: self._leader.time)

    def run(self, seconds: float, console: Console) -> None:
        """Let ``seconds`` of simulated time pass, or until Ctrl-C."""
        view = TreesView(self._recorder, self.zone, self.names)
        progress = Progress(console=console)
        task = progress.add_task('walking', total=seconds)
        next_picture = 0.0
        with Live(console=console, auto_refresh=False, transient=True) as screen:

            def finished() -> bool:
                nonlocal next_picture
                now, elapsed = time.perf_counter(), self._leader.elapsed
                if console.is_terminal and now >= next_picture:
                    next_picture = now + REFRESH
                    progress.update(task, completed=elapsed)
                    screen.update(Group(view.draw(), progress), refresh=True)
                ended = self._stop.requested or bool(self._recorder.failure)
                return ended or elapsed >= seconds

            spin([self._recorder, *self._nodes, *self._simulators], finished)
        self._recorder.close()
        rclpy.try_shutdown()


class _Minds(NamedTuple):
    """All nodes of one tree but its simulator."""

    probe: LiveNode[GranierProbe]
    motion: LiveNode[MotionGenerator]
    wheels: LiveNode[WheelKinematics]
    localization: LiveNode[Localization]


def _minds(name: str, names: Sequence[str], zone: str, seed: int) -> _Minds:
    """Return the nodes of the tree ``name``."""
    others = [other for other in names if other != name]
    shared = {
        'rate': RATE, 'share_zone': True, 'traffic__expected': others, 'zone_file': zone,
        'goals__seed': seed,
    }  # fmt: skip
    return _Minds(
        LiveNode(GranierProbe, **_given('granier_probe', name, {'simulated__seed': seed})),
        LiveNode(MotionGenerator, **_given('motion_generator', name, shared)),
        LiveNode(WheelKinematics, **_given('wheel_kinematics', name, {'rate': RATE})),
        LiveNode(Localization, **_given('localization', name, {})),
    )


def _given(node: str, name: str, changes: dict[str, Any]) -> dict[str, Any]:
    changes = {'use_sim_time': node != 'simulator', **changes}
    return {'namespace': name, **configured('tree.yaml', node, changes)}
