"""What is known of one robot: its newest messages, its shape, and where it was."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.dashboard.core import conversions
from agv_motion.dashboard.core.trail import DayChart, Trail

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.dashboard.core.entry import Entry

MEASURED = ('turrets/state', 'wheels/state', 'odom', 'pose')
"""What a robot measures all the time, moving or not"""
NODE_OLD = 5.0
"""[s] after which the word of a node counts no more: each speaks once a second"""
LONGEST_PERIOD = 60.0
"""[s] A node that speaks less often is old between two words."""
STILL = 1e-3
"""[m/s] A wheel that is slower stands: encoders have noise."""
PROBES = 9


class NodeWord(NamedTuple):
    """What a node said last of itself."""

    at: float
    """when that was [s]"""
    told: dict[str, Any]
    period: float = 0.0
    """after how long it had spoken again [s]: in a bag of simulated time that may be a minute"""

    def is_old(self, now: float) -> bool:
        """Return whether it counts no more at a time [s]."""
        return now - self.at > max(NODE_OLD, 3.0 * min(self.period, LONGEST_PERIOD))


class RobotState:
    """One robot as the page knows it."""

    def __init__(self, name: str) -> None:
        """Know nothing but the name."""
        self.name = name
        self.latest: dict[str, Entry] = {}
        """newest message by relative topic"""
        self.nodes: dict[str, NodeWord] = {}
        """what each of its nodes said last of itself"""
        self.platform: dict[str, Any] = {}
        """its shape in its own frame, where somebody has told it"""
        self.platform_number = 0
        self.trail, self.day = Trail(), DayChart()
        self.trail_number = self.day_number = 0
        self.word, self.word_since = '', 0.0
        self._turrets: dict[str, tuple[tuple[int, int], dict[str, Any]]] = {}
        """of each topic of turrets what it told, and for which message and shape"""
        self._speeds: list[float | None] = []
        self._speeds_key: tuple[int, ...] = ()
        """for which messages and shape the speeds were computed"""

    def message(self, topic: str) -> Any:
        """Return the newest message of a topic; None without one."""
        entry = self.latest.get(topic)
        return None if entry is None else entry.message

    def converted(self, topic: str, convert: Callable[[Any], Any]) -> Any:
        """Return what ``convert`` makes of the newest message, once each; None without one."""
        entry = self.latest.get(topic)
        return None if entry is None or entry.message is None else entry.converted(convert)

    def age(self, topic: str, now: float) -> float | None:
        """Return how long ago a topic spoke [s]; None if it never did."""
        entry = self.latest.get(topic)
        return None if entry is None else max(now - entry.at, 0.0)

    @property
    def kind(self) -> str:
        """tree, differential or omni; by its shape, or else by its wheels."""
        told = self.platform.get('kind')
        if isinstance(told, str):
            return told
        if 'turrets/state' in self.latest or 'turrets/command' in self.latest:
            return 'tree'
        joints = self.message('wheels/state') or self.message('wheels/command')
        if joints is None:
            return 'unknown'
        return 'differential' if len(joints.name) == 2 else 'omni'

    def wheel_speeds(self) -> list[float | None]:
        """Return what is measured of each wheel [m/s], or [rad/s] where no radius is known."""
        entries = [self.latest.get(topic) for topic in ('turrets/state', 'wheels/state')]
        key = (*(entry.number if entry else 0 for entry in entries), self.platform_number)
        if key != self._speeds_key:
            self._speeds_key, self._speeds = key, self._measured_speeds()
        return self._speeds

    def turrets(self, topic: str) -> dict[str, Any] | None:
        """Return what a topic of turrets told last, converted once; None without a message."""
        entry = self.latest.get(topic)
        if entry is None or entry.message is None:
            return None
        key = entry.number, self.platform_number
        known = self._turrets.get(topic)
        if known is None or known[0] != key:
            known = self._turrets[topic] = key, conversions.turrets(entry.message, self.radius)
        return known[1]

    def _measured_speeds(self) -> list[float | None]:
        told = self.turrets('turrets/state')
        if told is not None and self.radius is not None:
            known: list[float | None] = told['speeds']
            return known
        if told is not None:
            rates: list[float | None] = conversions.turret_rates(self.message('turrets/state'))
            return rates
        joints = self.message('wheels/state')
        if joints is None:
            return []
        fixed: list[float | None] = conversions.wheels(joints, self.radii or [1.0])['speeds']
        return fixed

    @property
    def radius(self) -> float | None:
        """Of the wheels of a tree [m]."""
        radius = self.platform.get('wheel_radius')
        return radius if isinstance(radius, float) else None

    @property
    def radii(self) -> list[float | None]:
        """Of fixed wheels [m]."""
        radii = self.platform.get('wheel_radii', [self.radius])
        return list(radii) if isinstance(radii, list) else []

    def stands(self) -> bool:
        """Return whether every wheel is measured to stand; False where nothing is measured."""
        speeds = self.wheel_speeds()
        return bool(speeds) and all(s is not None and abs(s) < STILL for s in speeds)

    def moves(self) -> bool:
        """Return whether a wheel is measured to turn."""
        return any(s is not None and abs(s) >= STILL for s in self.wheel_speeds())
