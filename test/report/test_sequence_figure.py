"""The picture of a sequence as predicted."""

from __future__ import annotations

from agv_motion.planar import Pose
from agv_motion.report.sequence_figure import draw as draw_sequence
from agv_motion.ros.config import find_config
from agv_motion.route.parameters import FollowParameters
from agv_motion.sequence.prediction import predict as predict_sequence
from agv_motion.sequence.sequence_file import load_sequence
from agv_motion.trajectory.ghost_parameters import GhostParameters


def test_a_sequence(sketched, tmp_path):
    found = load_sequence(find_config('sequence_example.yaml'))
    start = Pose(0.0, 0.0, 0.0)
    predicted = predict_sequence(found, start, GhostParameters(), FollowParameters())
    draw_sequence(found.name, start, predicted, tmp_path / 'sequence.png')
    sketched.check()
    texts = [text for text, _ in sketched[-1][1]]
    assert any(t.startswith('Round trip: seven actions, ') for t in texts)
    assert {'2, 3', 'start, 7'} <= set(texts)
