"""Topics of a bag that tell poses in space, without a Python object for every message."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.columns.columns import read_topic
from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.report.run import DRIVEN, POSES, named_so
from agv_motion.report.stamped_columns import require_type, topics_of
from agv_motion.report.stamped_poses import StampedPoses, stamped_poses

if TYPE_CHECKING:
    from agv_motion.bag.reader import BagReader


def read_poses(bag: BagReader, topic: str) -> StampedPoses:
    """Return a topic of PoseStamped, PoseWithCovarianceStamped or Odometry, by header stamps.

    Raises:
        ConfigurationError: It is not there, or of another type.
        SourceError: The bag is damaged, or one of its numbers cannot be that of a pose.

    """
    topic = f'/{topic.lstrip("/")}'
    require_type(bag, [topic], POSES)
    kind = next(one.type for one in bag.connections if one.topic == topic)
    pose = POSES[kind]
    columns = read_topic(bag, topic, ['header', pose])
    fields: dict[str, Any] = columns.fields
    places, turns = (
        np.stack([fields[f'{pose}.{part}.{axis}'] for axis in axes], axis=1)
        for part, axes in (('position', 'xyz'), ('orientation', 'xyzw'))
    )
    frames = sorted(set(fields['header.frame_id']))
    if len(frames) > 1:
        msg = f'{topic} changes its frame: it tells poses in {" and ".join(map(repr, frames))}'
        raise SourceError(msg)
    stamps = columns.nanoseconds('header.stamp')
    return stamped_poses(topic, frames[0] if frames else '', stamps, places, turns)


def driven_beside(bag: BagReader, reference: StampedPoses) -> StampedPoses:
    """Return the most trusted other topic that tells where the robot was.

    In the frame of the reference if one is.

    Raises:
        ConfigurationError: There is none.
        SourceError: As :func:`read_poses`.

    """
    topics = [t for t in topics_of(bag, POSES) if t != reference.name and bag.counts[t]]
    first: StampedPoses | None = None
    for topic in named_so(topics, DRIVEN):
        poses = read_poses(bag, topic)
        if poses.frame == reference.frame:
            return poses
        first = first or poses
    if first is None:
        found = f'name one of {", ".join(topics)}' if topics else 'there are none at all'
        msg = f'{bag.path}: no poses beside {reference.name} are named as usual; --driven: {found}'
        raise ConfigurationError(msg)
    return first
