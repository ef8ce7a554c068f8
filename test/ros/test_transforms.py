"""/tf where tf2_msgs is not installed: one node of a robot says so."""

from __future__ import annotations

from unittest.mock import MagicMock

import pytest

pytest.importorskip('rclpy')

from agv_motion.nodes.robot_model import RobotModelNode, RobotModelParameters
from agv_motion.ros import transforms


@pytest.mark.parametrize(('tf', 'times'), [('joints', 0), ('all', 1), ('none', 0)])
def test_a_robot_without_tf2_msgs_says_so_once(monkeypatch, tf, times):
    """Beside localization (``tf: joints``) that is the one who says it."""
    monkeypatch.setattr(transforms, 'TFMessage', None)
    port = MagicMock()
    RobotModelNode(port, RobotModelParameters(tf=tf))
    assert sum('tf2_msgs' in str(call) for call in port.info.mock_calls) == times
    assert not [call for call in port.publisher.mock_calls if '/tf' in str(call)]


def test_who_tells_all_others_says_why_there_are_none(monkeypatch):
    monkeypatch.setattr(transforms, 'TFMessage', None)
    port = MagicMock()
    assert not transforms.Transforms(port).available
    port.info.assert_called_once()
