"""Who may do what through the endpoint: to look is for all who have logged in, to act for few.

Nothing here leads past a robot's arbiter: who wants to move one speaks on the topics that the
arbiter takes from people, and its STOP, limits and locks hold as for everybody. What an autonomous
source says (`cmd_vel/agent`, `cmd_vel/route`), what the arbiter says (`cmd_vel`) and what drives
wheels (`turrets/command`, `wheels/command`) cannot be published.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.dashboard.foxglove.protocol import Capability

if TYPE_CHECKING:
    from collections.abc import Mapping

TWISTS = 'geometry_msgs/msg/TwistStamped', 'geometry_msgs/msg/Twist'
HAND, STOP = 'cmd_vel/manual', 'cmd_vel/stop'
PUBLISHABLE: Mapping[str, tuple[str, ...]] = {
    HAND: TWISTS,
    STOP: TWISTS,
    'goal_pose': ('geometry_msgs/msg/PoseStamped',),
    'initialpose': ('geometry_msgs/msg/PoseWithCovarianceStamped',),
    'clicked_point': ('geometry_msgs/msg/PointStamped',),
    'mark': ('std_msgs/msg/String',),
}
"""What a person may say, relative to the namespace of a robot, and the types for it"""

OPERATED = (
    'arbiter/stop', 'arbiter/lock_manual', 'motion_generator/pause', 'sequence/pause',
    'route_follower/pause', 'motion_generator/go_home', 'motion_generator/next_goal',
    'localization/set_pose',
)  # fmt: skip
"""Services that an operator may call, as on the page; an expert may call all but `CLOSED`"""
CLOSED = ('set_parameters', 'set_parameters_atomically', 'change_state')
"""Last parts of services that nobody calls here: parameters are set as such, and then checked; and
an arbiter that is configured anew would know of its STOP no more"""


class Permissions(NamedTuple):
    """What one client may do."""

    acts: bool = False
    """publish what persons say, call the services of operators"""
    changes: bool = False
    """set parameters, call other services"""

    def capabilities(self, *, simulated: bool) -> list[Capability]:
        """Return what the client is offered on a live graph."""
        found = [Capability.PARAMETERS, Capability.WATCH_PARAMETERS, Capability.GRAPH]
        if simulated:
            found.append(Capability.TIME)
        if self.acts:
            found += [Capability.PUBLISH, Capability.SERVICES]
        return found

    def refuses_topic(self, topic: str, kind: str) -> str:
        """Return why the client may not publish a topic with a type; empty if it may."""
        if not self.acts:
            return READ_ONLY
        relative = next((one for one in PUBLISHABLE if topic.endswith(f'/{one}')), None)
        if relative is None:
            return (
                f"'{topic}' cannot be published here; of a robot there can be "
                f'{", ".join(PUBLISHABLE)}: what moves it comes by its arbiter'
            )
        if kind not in PUBLISHABLE[relative]:
            return f"'{topic}' is of {' or '.join(PUBLISHABLE[relative])}, not {kind}"
        return ''

    def sees_service(self, name: str) -> bool:
        """Return whether the client may call a service, and so is told of it."""
        if not self.acts or name.endswith(tuple(f'/{one}' for one in CLOSED)):
            return False
        return self.changes or name.endswith(tuple(f'/{one}' for one in OPERATED))


READ_ONLY = (
    'this endpoint only shows: an operator or expert may act where it was started with '
    '--foxglove-acts'
)
