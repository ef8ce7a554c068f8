"""Names of frames: each robot's own begin with its prefix, those of the map are shared by all.

    map ──> oak/odom ──> oak/base_link ──> oak/turret_0 ──> oak/wheel_0

Without a prefix three robots on one graph would publish the same frames, and no tool could tell one
from another. As robot_state_publisher does, names stand in parameters, messages and the URDF
without it, and get it where they become frames.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec

if TYPE_CHECKING:
    from typing_extensions import Self

OWN = ('base_frame', 'odom_frame', 'imu_frame')
"""Parameters that name frames of the robot itself"""
SHARED = ('map_frame',)
"""Parameters that name frames of all robots"""
NO_PREFIX = '/'


@dataclass(frozen=True)
class FrameParameters:
    """The frame of the robot, and what stands before all frames of its own."""

    frame_prefix: Annotated[
        str,
        Spec(
            "before the names of this robot's frames, as robot_state_publisher has it, such as "
            'oak/; empty: its namespace; /: nothing'
        ),
    ] = ''
    base_frame: Annotated[str, Spec('frame of the robot, and of its twists')] = 'base_link'

    def in_namespace(self, namespace: str) -> Self:
        """Return the same with all names as they are on the graph, in a ``namespace``.

        A leading slash, and a prefix that is there already, add nothing.

        Raises:
            ConfigurationError: A name is empty, or two frames of the tree bear the same.

        """
        prefix = self.frame_prefix or f'{namespace}/'
        placed = replace(self, frame_prefix=prefix.lstrip('/') or NO_PREFIX)
        own = {name: placed.own(getattr(self, name)) for name in self.own_names()}
        shared = {name: getattr(self, name).lstrip('/') for name in self.shared_names()}
        found: dict[str, str] = {}
        for name, frame in (own | shared).items():
            if frame in {'', placed.prefix}:
                msg = f"{name} = '{getattr(self, name)}': give the frame a name"
                raise ConfigurationError(msg)
            if frame in found and name != 'imu_frame':
                msg = f"{name} and {found[frame]} are both '{frame}': a frame cannot hold itself"
                raise ConfigurationError(msg)
            found.setdefault(frame, name)
        return replace(placed, **own, **shared)

    @property
    def prefix(self) -> str:
        """Before the frames of this robot, once they are `in_namespace`; empty: nothing."""
        return '' if self.frame_prefix == NO_PREFIX else self.frame_prefix

    def own(self, frame: str) -> str:
        """Return a frame of this robot by its name on the graph; '' stays: it is not told."""
        frame, prefix = frame.lstrip('/'), self.prefix
        return frame if not frame or frame.startswith(prefix) else prefix + frame

    def own_names(self) -> tuple[str, ...]:
        """Return which parameters name frames of the robot itself."""
        return tuple(name for name in OWN if hasattr(self, name))

    def shared_names(self) -> tuple[str, ...]:
        """Return which parameters name frames of all robots."""
        return tuple(name for name in SHARED if hasattr(self, name))


def in_namespace(values: Any, namespace: str) -> Any:
    """Return parameters with their frames as they are on the graph; others as they are."""
    return values.in_namespace(namespace) if isinstance(values, FrameParameters) else values
