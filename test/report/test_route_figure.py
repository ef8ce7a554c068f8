"""The picture of a route as predicted."""

from __future__ import annotations

from agv_motion.planar import Pose
from agv_motion.report.route_figure import draw as draw_route
from agv_motion.ros.config import find_config
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.prediction import predict as predict_route
from agv_motion.route.route_file import load_route


def test_a_route(sketched, tmp_path):
    found = load_route(find_config('route_example.yaml'), 1)
    run = predict_route(found, FollowParameters(), Pose(0.0, 0.0, 0.0), 0.05)
    draw_route(found, run, tmp_path / 'route.png')
    sketched.check()
    texts = [text for text, _ in sketched[-1][1]]
    assert {'start', 'end', 'at top speed', 'the end is near'} <= set(texts)
