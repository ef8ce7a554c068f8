"""A drive in a bag as the calibration wants it: turns of the wheels, and places on the way."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.errors import ConfigurationError
from agv_motion.odometry.calibration_recording import CalibrationDrive
from agv_motion.report.stamped_columns import (
    POSES,
    JointColumns,
    PoseColumns,
    joint_columns,
    pose_columns,
    topics_of,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from numpy.typing import NDArray

    from agv_motion.bag.reader import BagReader
    from agv_motion.report.stamped_columns import Array

TRUSTED = ('fix', 'pose', 'ground_truth')
"""Ends of the names of topics that tell places from outside, the first that is there."""

UNTOLD_NOISE = 0.15
"""[m] of a place whose message tells no covariance"""
MOVED = 0.5
"""[rad] A robot whose wheels turned less on average stood."""
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


class RecordedDrive(NamedTuple):
    """A drive from a bag."""

    recording: CalibrationDrive
    topic: str
    """of its references"""
    notes: list[str]
    """what was left out"""


def read_drive(
    bag: BagReader, wheels: Wheels, reference: str = '', prefix: str = ''
) -> RecordedDrive:
    """Return a drive.

    Args:
        bag: Open.
        wheels: Where the wheels are.
        reference: Topic of the places; empty: found by its name.
        prefix: Namespace of the robot, such as ``/oak``: no other robot's places are taken.

    Raises:
        SourceError: The bag is damaged.
        ConfigurationError: A topic or a joint is missing, nothing moved, or the two do not overlap
            in time.

    """
    notes: list[str] = []
    joints = joint_columns(bag, wheels.topic, [*wheels.wheels, *wheels.steering])
    topic = reference or _trusted(bag, prefix)
    (places,) = pose_columns(bag, [topic])
    places = PoseColumns(*_finite(places, (places.pose,), topic, notes))
    count = len(wheels.wheels)
    by_angle = _by_angle(joints, count)
    rolled = (joints.position if by_angle else joints.velocity)[:count]
    needed = rolled, joints.position[count:]
    joints = JointColumns(*_finite(joints, needed, wheels.topic, notes))
    if len(joints.stamp) < 2:
        msg = (
            f'{wheels.topic} tells neither angles nor rates of all wheels and turrets in two '
            'messages: nothing to calibrate'
        )
        raise ConfigurationError(msg)
    turned = _turned(joints, count, wheels.encoder_range, by_angle=by_angle)
    if np.abs(turned).sum() < MOVED * count:
        msg = (
            f'the robot stood: its wheels turned {np.abs(turned).sum(axis=1).max():.3f} rad on '
            f'{wheels.topic} in {np.ptp(joints.stamp):.0f} s; record while it drives'
        )
        raise ConfigurationError(msg)
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
    recording = CalibrationDrive(turned, step, pose, position_noise, heading_noise, steering)
    return RecordedDrive(recording, topic, notes)


def _finite(
    columns: PoseColumns | JointColumns, needed: Iterable[Array], topic: str, notes: list[str]
) -> Iterator[Array]:
    """Yield columns without the messages in which something needed is not finite, and note them."""
    whole = np.asarray(np.isfinite(np.vstack([columns.stamp, *needed])).all(axis=0))
    if not whole.all():
        notes.append(
            f'{topic}: {np.sum(~whole)} of {len(whole)} messages left out, they are not finite'
        )
    return (np.asarray(column)[..., whole] for column in columns)


def _trusted(bag: BagReader, prefix: str) -> str:
    """Return the topic of places of the robot in a namespace, by its name."""
    topics = topics_of(bag, POSES)
    mine = [
        name
        for name in topics
        if (name.startswith(f'{prefix}/') if prefix else name.count('/') == 1)
    ]
    for end in TRUSTED:
        for name in mine:
            if name.endswith(f'/{end}'):
                return name
    whose = f' of {prefix}' if prefix else ''
    msg = f'{bag.path} has no fix, pose or ground_truth{whose}: name a topic with --reference, or '
    msg += f'the robot with --namespace; there is {", ".join(topics) or "no topic of places"}'
    raise ConfigurationError(msg)


def _by_angle(joints: JointColumns, count: int) -> bool:
    """Return whether the angles tell how the wheels turned: they move, or there are no rates."""
    told = np.asarray(np.isfinite(joints.position[:count]).all(axis=0))
    if 2 * told.sum() <= len(told):
        return False
    moves = (np.ptp(joints.position[:count, told], axis=1) > 0.0).any()
    return bool(moves or not np.isfinite(joints.velocity[:count]).all(axis=0).any())


def _turned(joints: JointColumns, count: int, encoder_range: float, *, by_angle: bool) -> Array:
    """Return (wheels, steps) turns [rad], by the angles or the rates."""
    if by_angle:
        angle = joints.position[:count]
        if encoder_range > 0.0:
            angle = np.unwrap(angle, period=encoder_range)
        return np.diff(angle)
    rate = joints.velocity[:count]
    turned: Array = 0.5 * (rate[:, 1:] + rate[:, :-1]) * np.diff(joints.stamp)
    return turned


def _nearest(stamps: Array, times: Array) -> NDArray[np.int_]:
    """Return the index of the stamp nearest to each time."""
    after = np.searchsorted(stamps, times).clip(1, len(stamps) - 1)
    nearer = (times - stamps[after - 1]) < (stamps[after] - times)
    return np.asarray(after - nearer, dtype=np.int_)


def _noise(covariance: Array) -> tuple[float, float]:
    """Return the usual deviation of a position [m] and of a heading [rad], of those that tell."""
    position = _usual(0.5 * (covariance[0] + covariance[3]))
    heading = _usual(covariance[5])
    return position or UNTOLD_NOISE, heading or KNOWN_HEADING


def _usual(variance: Array) -> float:
    """Return the root of the median; 0 where most messages tell nothing."""
    told = variance[np.isfinite(variance) & (variance > 0.0)]
    return float(np.sqrt(np.median(told))) if 2 * len(told) > len(variance) else 0.0


def joints_of_turrets(count: int) -> tuple[list[str], list[str]]:
    """Return the names of the wheels and of the steering joints of ``count`` turrets."""
    return (
        [f'turret_{i}_wheel' for i in range(count)],
        [f'turret_{i}_steering' for i in range(count)],
    )
