"""Quality of service that a topic was offered with, as rosbag2 keeps it (metadata version 9)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import yaml

if TYPE_CHECKING:
    from collections.abc import Iterable

FOREVER = 2**63 - 1
"""[ns] The longest time, with which ROS says that there is no limit."""


class OfferedQos(NamedTuple):
    """One publisher's quality of service, in the words of ROS."""

    depth: int = 10
    reliability: str = 'reliable'
    durability: str = 'volatile'
    history: str = 'keep_last'
    liveliness: str = 'automatic'
    deadline: int = FOREVER
    """[ns]"""
    lifespan: int = FOREVER
    """[ns]"""
    lease_duration: int = FOREVER
    """[ns]"""

    def entries(self) -> dict[str, Any]:
        """Return what rosbag2 writes, in its order."""
        return {
            'history': self.history,
            'depth': self.depth,
            'reliability': self.reliability,
            'durability': self.durability,
            'deadline': _time(self.deadline),
            'lifespan': _time(self.lifespan),
            'liveliness': self.liveliness,
            'liveliness_lease_duration': _time(self.lease_duration),
            'avoid_ros_namespace_conventions': False,
        }


def as_yaml(profiles: Iterable[OfferedQos]) -> str:
    """Return the profiles of a topic's publishers as a channel keeps them."""
    entries = [profile.entries() for profile in profiles]
    return yaml.safe_dump(entries, sort_keys=False) if entries else ''


def _time(nanoseconds: int) -> dict[str, int]:
    sec, nsec = divmod(nanoseconds, 1_000_000_000)
    return {'sec': sec, 'nsec': nsec}
