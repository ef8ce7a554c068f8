"""What `motion_generator` tells of its zone, hears of those of others, and asks of another one."""

from __future__ import annotations

import re
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from std_msgs.msg import String

from agv_motion.errors import ConfigurationError
from agv_motion.motion.navigation.zone_text import LONGEST, same_floor, text_of_zone
from agv_motion.ros.qos import LATCHED

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.motion.navigation.path_planner import PathPlanner
    from agv_motion.motion.navigation.zone import Zone
    from agv_motion.planar import Pose
    from agv_motion.ros.port import Port

NAMESPACE = re.compile(r'[A-Za-z][A-Za-z0-9_]*\Z')
"""Names that may be those of namespaces"""


class ZoneReport:
    """Tells the zone in force, and finds out who of those that share it has another.

    What keeps trees apart does not rest on the zone; one that knows another floor than the others
    only looks for paths and refuges where they cannot be.
    """

    def __init__(self, port: Port, others: Iterable[str] = ()) -> None:
        """Open the topics.

        Args:
            port: Of the node.
            others: Names of the trees that share the zone, which are their namespaces.

        """
        self._port = port
        self._told = ''
        self._others: dict[str, str] = {}
        self._publisher = port.publisher(String, 'zone', LATCHED, sole=True)
        for name in filter(NAMESPACE.match, others):
            port.listen(String, f'/{name}/zone', partial(self._on_zone, name), LATCHED)

    def publish(self, zone: Zone | None) -> None:
        """Tell the zone in force; without one there is nothing to tell."""
        if zone is not None:
            self._told = text_of_zone(zone)
            self._publisher.publish(String(data=self._told))

    def different(self) -> list[str]:
        """Return the names of those whose boundary or holes are others."""
        return sorted(n for n, text in self._others.items() if not same_floor(text, self._told))

    def _on_zone(self, name: str, message: String) -> None:
        self._others[name] = message.data[:LONGEST]


class Whereabouts(NamedTuple):
    """Where a tree stands, and the paths of the zone in which it does."""

    pose: Pose
    planner: PathPlanner


def require_standing(
    pose: Pose | None, planner: PathPlanner | None, before: Zone | None
) -> Whereabouts:
    """Return pose and planner if the tree stands in the zone that it is to go on in.

    Args:
        pose: Where it is; None: nobody knows.
        planner: The paths of the zone that was asked for; None: none was.
        before: The zone that it is in; None: it began without one.

    Raises:
        ConfigurationError: It does not, or nobody can know.

    """
    if planner is None or before is None:
        msg = 'zone: it begins with a zone or without: set zone_file, and start the node anew'
        raise ConfigurationError(msg)
    if pose is None:
        msg = 'zone: no pose, so nobody knows whether the tree stands in it: wait for one'
        raise ConfigurationError(msg)
    zone = planner.zone
    if not zone.holds(pose.x, pose.y):
        msg = (
            f'zone: the tree, at ({pose.x:.2f}, {pose.y:.2f}), {zone.why_not(pose.x, pose.y)}: '
            'drive it in first, or draw the zone round it'
        )
        raise ConfigurationError(msg)
    return Whereabouts(pose, planner)
