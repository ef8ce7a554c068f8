"""A drive in a bag as the calibration wants it: turns of the wheels, and places on the way."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.cli.bag_columns import joint_columns, pose_columns, topics_of
from agv_motion.errors import ConfigurationError
from agv_motion.odometry.calibration_recording import Recording

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.cli.bag_columns import Array, JointColumns

POSES = ('nav_msgs/msg/Odometry', 'geometry_msgs/msg/PoseWithCovarianceStamped')
TRUSTED = ('fix', 'pose', 'ground_truth')
"""Ends of the names of topics that tell places from outside, the first that is there."""

UNTOLD_NOISE = 0.15
"""[m] of a place whose message tells no covariance"""
KNOWN_HEADING = 1.0
"""[rad] A heading less sure than this is none."""


class Wheels(NamedTuple):
    """Where the wheels of a base are in a bag."""

    topic: str
    """its joint states"""
    wheels: list[str]
    """joints whose angle or rate tells how far a wheel rolled"""
    steering: list[str]
    """joints whose angle is that of a turret; empty where nothing steers"""
    encoder_range: float = 0.0
    """[rad] at which the angles start again; 0: never"""


def read_drive(bag: Path, wheels: Wheels, reference: str = '') -> tuple[Recording, str]:
    """Return a drive, and the topic of its references.

    Args:
        bag: Folder or file.
        wheels: Where the wheels are.
        reference: Topic of the places; empty: found by its name.

    Raises:
        SourceError: The bag cannot be read.
        ConfigurationError: A topic or a joint is missing, or the two do not overlap in time.

    """
    joints = joint_columns(bag, wheels.topic, [*wheels.wheels, *wheels.steering])
    topic = reference or _trusted(bag)
    (places,) = pose_columns(bag, [topic])
    count = len(wheels.wheels)
    turned = _turned(joints, count, wheels.encoder_range)
    angles = joints.position[count:]
    steering = 0.5 * (angles[:, 1:] + angles[:, :-1]) if wheels.steering else None
    within = (places.stamp >= joints.stamp[0]) & (places.stamp <= joints.stamp[-1])
    step, first = np.unique(_nearest(joints.stamp, places.stamp[within]), return_index=True)
    if len(step) < 2:
        msg = f'{topic} tells {len(step)} places while {wheels.topic} tells of the wheels: too few'
        raise ConfigurationError(msg)
    pose = places.pose[:, within][:, first]
    position_noise, heading_noise = _noise(places.covariance[:, within])
    if heading_noise >= KNOWN_HEADING:
        pose[2] = np.nan
    return Recording(turned, step, pose, position_noise, heading_noise, steering), topic


def _trusted(bag: Path) -> str:
    topics = {name: kind for name, kind in topics_of(bag).items() if kind in POSES}
    for end in TRUSTED:
        for name in topics:
            if name.endswith(f'/{end}'):
                return name
    msg = f'{bag} has no fix, pose or ground_truth: name a topic of places with --reference; ' + (
        f'there is {", ".join(topics)}' if topics else 'there is none'
    )
    raise ConfigurationError(msg)


def _turned(joints: JointColumns, count: int, encoder_range: float) -> Array:
    """Return (wheels, steps) turns [rad], by the angles or, where those stand still, the rates."""
    angle, rate = joints.position[:count], joints.velocity[:count]
    if np.isfinite(angle).all() and (np.ptp(angle, axis=1) > 0.0).all():
        if encoder_range > 0.0:
            angle = np.unwrap(angle, period=encoder_range)
        return np.diff(angle)
    if not np.isfinite(rate).all():
        msg = 'the joint states tell neither angles nor rates of all wheels: nothing to calibrate'
        raise ConfigurationError(msg)
    return 0.5 * (rate[:, 1:] + rate[:, :-1]) * np.diff(joints.stamp)


def _nearest(stamps: Array, times: Array) -> NDArray[np.int_]:
    """Return the index of the stamp nearest to each time."""
    after = np.searchsorted(stamps, times).clip(1, len(stamps) - 1)
    nearer = (times - stamps[after - 1]) < (stamps[after] - times)
    return np.asarray(after - nearer, dtype=np.int_)


def _noise(covariance: Array) -> tuple[float, float]:
    """Return the usual deviation of a position [m] and of a heading [rad]."""
    position = float(np.sqrt(np.median(0.5 * (covariance[0] + covariance[3]))))
    heading = float(np.sqrt(np.median(covariance[5])))
    known = np.isfinite(heading) and heading > 0.0
    return position if position > 0.0 else UNTOLD_NOISE, heading if known else KNOWN_HEADING


def joints_of_turrets(count: int) -> tuple[list[str], list[str]]:
    """Return the names of the wheels and of the steering joints of ``count`` turrets."""
    return (
        [f'turret_{i}_wheel' for i in range(count)],
        [f'turret_{i}_steering' for i in range(count)],
    )
