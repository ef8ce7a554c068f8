"""A bag of what a whole simulated tree says, made without middleware: the same bytes every time."""

from __future__ import annotations

from datetime import datetime, timezone
from typing import TYPE_CHECKING

from agv_motion.bag.writer import BagWriter
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.reprocess.recorded import parameters
from agv_motion.reprocess.transcript import Transcript
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode

if TYPE_CHECKING:
    from pathlib import Path

SECOND = 1_000_000_000
NOON = 1434366000
"""[s since 1970] of a day in June on which the sap flows"""
TREE = (GranierProbe, MotionGenerator, WheelKinematics, Simulator)
CONFIG = 'tree.yaml'


def record_simulated_tree(path: Path, seconds: int, begin: int = NOON, seed: int = 1) -> Path:
    """Record a tree of ``config/tree.yaml``; its pose is on `/fix`, as a measured one would be.

    Args:
        path: Folder of the bag; must not exist.
        seconds: How long.
        begin: When [s since 1970].
        seed: Of the noise in the simulation.

    Returns:
        ``path``.

    """
    start = datetime.fromtimestamp(begin, timezone.utc).strftime('%Y-%m-%dT%H:%M:%S')
    own = {'simulator': {'seed': seed, 'start_time': start}}
    with BagWriter(path) as writer:
        transcript = Transcript(writer)
        graph = InProcessGraph(transcript.record, begin * SECOND)
        for kind in TREE:
            given = parameters(CONFIG, kind.name) | own.get(kind.name, {})
            InProcessNode(graph, kind, given, {'/pose': '/fix'})
        graph.start()
        graph.run((begin + seconds) * SECOND)
        graph.stop()
        transcript.flush()
    return path
