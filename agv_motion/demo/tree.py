"""The graph of the demo: the five nodes of the tree and a recorder, on one executor."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TwistStamped, Vector3Stamped
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.signals import SignalHandlerOptions
from rich.live import Live
from sensor_msgs.msg import Illuminance, JointState, Temperature
from std_msgs.msg import Bool, Float64, String

from agv_motion.demo.configured import configured
from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
from agv_motion.demo.tree_view import DemoView
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.report.walk import WalkOutcome
from agv_motion.ros.config import find_config
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import spin, start
from agv_motion.ros.stop import Stop

if TYPE_CHECKING:
    import pathlib

    from numpy.typing import NDArray
    from rich.console import Console


REFRESH = 0.25
"""[s] between two pictures of the live view"""

TOPICS = [
    *(RecordedTopic(f'granier/probe_{i}/temperature_difference', Temperature) for i in (1, 2, 3)),
    RecordedTopic('granier/sap_flow', Vector3Stamped),
    RecordedTopic('granier/valid', Bool, latched=True),
    RecordedTopic('cmd_vel', TwistStamped),
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


class DemoGraph:
    """Builds the graph, runs it, and reports."""

    def __init__(
        self, probes: dict[str, Any], zone: str, seed: int, time_factor: float, bag: pathlib.Path
    ) -> None:
        """Create and start all nodes with the values of ``config/tree.yaml``.

        Args:
            probes: Parameters of `granier_probe` beside those.
            zone: Zone file; empty for that of the configuration.
            seed: Of all noise.
            time_factor: Simulated seconds per second.
            bag: Folder of the new bag.

        """
        rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
        self._stop = Stop()
        common: dict[str, Any] = {'use_sim_time': True}
        place: dict[str, Any] = {'zone_file': zone} if zone else {}
        probe = LiveNode(GranierProbe, **configured('tree.yaml', 'granier_probe', common | probes))
        motion = LiveNode(
            MotionGenerator,
            **configured('tree.yaml', 'motion_generator', common | place | {'goals__seed': seed}),
        )
        self.zone = load_zone(find_config(motion.parameters.zone_file), motion.parameters.rim)
        wheels = LiveNode(WheelKinematics, **configured('tree.yaml', 'wheel_kinematics', common))
        localization = LiveNode(Localization, **configured('tree.yaml', 'localization', common))
        start_at = dict(zip(('start_x', 'start_y'), self.zone.home or (0.0, 0.0), strict=True))
        self._simulator = LiveNode(
            Simulator,
            **configured(
                'tree.yaml', 'simulator', {'time_factor': time_factor, 'seed': seed, **start_at}
            ),
        )
        self._nodes: list[LiveNode[Any]] = [
            probe, motion, wheels, localization, self._simulator,
        ]  # fmt: skip
        self.wheels = wheels.parameters
        for node in self._nodes:
            start(node)
        simulator = self._simulator.plain
        self._recorder = DemoRecorder(bag, TOPICS, lambda: simulator.time)

    def run(self, seconds: float, console: Console, *, live: bool) -> None:
        """Let ``seconds`` of simulated time pass, or until Ctrl-C."""
        self._begun = time.perf_counter()
        view = DemoView(self._recorder, self.zone, self._simulator.parameters)
        next_picture, simulator = 0.0, self._simulator.plain
        with Live(console=console, auto_refresh=False, transient=True) as screen:

            def finished() -> bool:
                nonlocal next_picture
                now = time.perf_counter()
                if live and console.is_terminal and now >= next_picture:
                    next_picture = now + REFRESH
                    screen.update(view.draw(simulator.time, self._factor()), refresh=True)
                ended = self._stop.requested or bool(self._recorder.failure)
                return ended or simulator.elapsed >= seconds

            spin([self._recorder, *self._nodes], finished)
        self.outcome = WalkOutcome(
            self._simulator.plain.elapsed, self._factor(), self._latencies(), self._recorder.counts
        )
        self._recorder.close()
        rclpy.try_shutdown()

    def idle(self, begun: float, seconds: float) -> tuple[float, float]:
        """Run for ``seconds``; return when the wheels first turned after ``begun`` and the load.

        Args:
            begun: When the process began, by `time.perf_counter` [s].
            seconds: How long to run [s].

        Returns:
            Time from ``begun`` to the first turret command [s], and processor time per second.

        """
        used, until = time.process_time(), time.perf_counter() + seconds
        spin([self._recorder, *self._nodes], lambda: time.perf_counter() > until)
        load = (time.process_time() - used) / seconds
        first = self._recorder.arrivals['turrets/command'][0] * 1e-9 - begun
        self._recorder.close()
        rclpy.try_shutdown()
        return first, load

    def _factor(self) -> float:
        return self._simulator.plain.elapsed / max(time.perf_counter() - self._begun, 1e-9)

    def _latencies(self) -> NDArray[np.float64]:
        """Return the times from a sap flow to the turret command that follows it [s]."""
        flows, commands = (
            np.array(self._recorder.arrivals[topic], dtype=float)
            for topic in ('granier/sap_flow', 'turrets/command')
        )
        after = np.searchsorted(commands, flows)
        known = after < len(commands)
        latencies: NDArray[np.float64] = (commands[after[known]] - flows[known]) * 1e-9
        return latencies
