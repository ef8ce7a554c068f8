"""Quality of service that a topic was offered with, as rosbag2 keeps it (metadata version 9)."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.errors import ConfigurationError
from agv_motion.files import yaml_text

if TYPE_CHECKING:
    from collections.abc import Iterable

FOREVER = 2**63 - 1
"""[ns] The longest time, with which ROS says that there is no limit."""
WORDS = {
    'history': ('system_default', 'keep_last', 'keep_all', 'unknown'),
    'reliability': ('system_default', 'reliable', 'best_effort', 'unknown', 'best_available'),
    'durability': ('system_default', 'transient_local', 'volatile', 'unknown', 'best_available'),
    'liveliness': (
        *('system_default', 'automatic', 'manual_by_node', 'manual_by_topic'),
        *('unknown', 'best_available'),
    ),
}
"""Words by the numbers of rmw, which rosbag2 wrote before metadata version 9."""


KEYS = (
    *WORDS, 'depth', 'deadline', 'lifespan', 'liveliness_lease_duration',
    'avoid_ros_namespace_conventions',
)  # fmt: skip
"""Of one profile in a file."""

USUAL = 2000
"""[characters] below which the text of a topic is that of many others: it is read once"""

NO_PROFILE = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""What comes of entries that are no profile: a word for a number, a list for keys, infinity."""


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

    @classmethod
    def from_yaml(cls, text: str) -> tuple[OfferedQos, ...]:
        """Return the profiles of a topic's publishers; what cannot be read counts as not given."""
        return _usual(text) if len(text) < USUAL else _profiles(text)

    @classmethod
    def from_entries(cls, entries: dict[str, Any]) -> OfferedQos:
        """Return a profile from what rosbag2 wrote, of any version.

        Raises:
            ArithmeticError, AttributeError, LookupError, TypeError, ValueError: It is none.

        """
        words: dict[str, Any] = {key: _word(key, entries[key]) for key in WORDS if key in entries}
        times: dict[str, Any] = {
            field: nanoseconds(entries[key])
            for field, key in (
                *(('deadline', 'deadline'), ('lifespan', 'lifespan')),
                ('lease_duration', 'liveliness_lease_duration'),
            )
            if key in entries
        }
        depth = int(entries.get('depth', 10))
        if not 0 <= depth < 2**63:
            raise ValueError(depth)
        return cls(depth=depth, **words, **times)

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


def _profiles(text: str) -> tuple[OfferedQos, ...]:
    try:
        entries = yaml_text.plain(text, 'offered_qos_profiles') or []
        return tuple(OfferedQos.from_entries(entry) for entry in entries)
    except (ConfigurationError, *NO_PROFILE):
        return ()


_usual = lru_cache(maxsize=128)(_profiles)


def kept(profiles: Iterable[OfferedQos]) -> int:
    """Return how many messages the latched publishers of a topic keep for late listeners."""
    return sum(max(one.depth, 1) for one in profiles if one.durability == 'transient_local')


def as_yaml(profiles: Iterable[OfferedQos]) -> str:
    """Return the profiles of a topic's publishers as a channel keeps them."""
    entries = [profile.entries() for profile in profiles]
    return yaml_text.dump(entries) if entries else ''


def _time(nanoseconds: int) -> dict[str, int]:
    sec, nsec = divmod(nanoseconds, 1_000_000_000)
    return {'sec': sec, 'nsec': nsec}


def nanoseconds(time: dict[str, int]) -> int:
    """Return a time; zero and what is beyond ``FOREVER`` mean no limit."""
    return min(int(time['sec']) * 1_000_000_000 + int(time['nsec']), FOREVER) or FOREVER


def _word(key: str, value: Any) -> str:
    return WORDS[key][value if isinstance(value, int) else WORDS[key].index(value)]
