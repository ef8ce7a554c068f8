"""The robot of a bag at its true size, with its wheels as they stood at some times."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from agv_motion.bag.message_objects import decoded
from agv_motion.errors import ConfigurationError
from agv_motion.model.footprint import Footprint, footprint, steering_joints
from agv_motion.model.urdf_reading import read_urdf
from agv_motion.report.stamped_columns import JOINTS, joint_columns, topics_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.bag.reader import BagReader
    from agv_motion.model.robot_model import RobotModel
    from agv_motion.report.stamped_columns import JointColumns

DESCRIPTION = 'robot_description'
PLATFORMS = 5
"""Times at which a robot is drawn on its way: at the start, thrice between, at the end"""
STATES = ('joint_states', 'turrets/state')
"""Topics that tell how joints stand"""


def moments(rows: int) -> list[int]:
    """Return the rows at which a robot is drawn, of a way of so many: the first to the last."""
    return sorted({int(row) for row in np.linspace(0, rows - 1, PLATFORMS)}) if rows else []


def read_footprints(bag: BagReader, topic: str, stamps: Iterable[float]) -> list[Footprint] | None:
    """Return what a robot covered of the floor at some times, in its own frame.

    Args:
        bag: Open.
        topic: Any of the robot's, for its namespace.
        stamps: Times [s], as headers of its messages have them.

    Returns:
        A footprint for each time; None where the bag does not tell the size of the robot.

    Raises:
        SourceError: The bag is damaged.

    """
    spaces, model = _namespaces(topic), read_model(bag, topic)
    if model is None:
        return None
    names = steering_joints(model)
    columns = _joints(bag, [f'{space}/{name}' for space in spaces for name in STATES], names)
    found = []
    for stamp in stamps:
        positions: dict[str, float] = {}
        if columns is not None:
            nearest = int(np.abs(columns.stamp - stamp).argmin())
            told = columns.position[:, nearest].tolist()
            positions = {n: at for n, at in zip(names, told, strict=True) if np.isfinite(at)}
        shape = footprint(model, positions)
        if shape is None:
            return None
        found.append(shape)
    return found


def read_model(bag: BagReader, topic: str) -> RobotModel | None:
    """Return the model of the robot that a topic is of; None where the bag has none."""
    found = (_model(bag, f'{space}/{DESCRIPTION}') for space in _namespaces(topic))
    return next((model for model in found if model is not None), None)


def _namespaces(topic: str) -> list[str]:
    """Return all namespaces that a topic may be of, the longest first."""
    parts = topic.strip('/').split('/')[:-1]
    return [''.join(f'/{part}' for part in parts[:n]) for n in range(len(parts), -1, -1)]


def _model(bag: BagReader, topic: str) -> RobotModel | None:
    """Return the model that was told last on a topic; None where there is none to be read."""
    if topic not in topics_of(bag, ['std_msgs/msg/String']):
        return None
    told = [content.data for _, content in decoded(bag, [topic])]
    try:
        return read_urdf(told[-1]) if told else None
    except ConfigurationError:
        return None  # a description of something else; its robot is drawn without a size


def _joints(bag: BagReader, topics: list[str], names: list[str]) -> JointColumns | None:
    """Return how joints stood, from the first of some topics that tells all of them."""
    known = topics_of(bag, [JOINTS])
    for topic in topics if names else ():
        if topic in known:
            try:
                return joint_columns(bag, topic, names)
            except ConfigurationError:
                continue  # joints of something else
    return None
