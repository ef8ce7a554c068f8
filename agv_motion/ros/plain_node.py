"""A node as this package writes it: a plain class that is given a port and parameters.

What runs it (`LiveNode` on a ROS graph, `InProcessNode` over a recording) gives it a life:
configure makes it, activate calls `begin`, deactivate calls `halt`, cleanup closes what it opened.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from agv_motion.ros.diagnosis import OK, Diagnosis

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

    from agv_motion.ros.port import Port

P = TypeVar('P', bound='DataclassInstance')


class PlainNode(Generic[P]):
    """A node between its configuration and its cleanup.

    A node tells its ``name`` and which parameters it ``takes``, builds its core and opens its
    topics in ``__init__``, and overrides what else it needs of the other four.
    """

    name: ClassVar[str]
    """of the node on the graph"""
    takes: ClassVar[type[Any]]
    """dataclass of its parameters, each declared once"""

    def __init__(self, port: Port, parameters: P) -> None:
        """Build the core and open the topics.

        Args:
            port: To the world.
            parameters: In force; replaced by others once `accept` has not refused them.

        Raises:
            AgvMotionError: The parameters do not allow it; the node stays unconfigured.

        """
        self.port, self.parameters = port, parameters

    def begin(self) -> None:
        """Start to act; what was known before counts no more."""

    def halt(self) -> None:
        """Leave every output safe; the topics are still open."""

    def accept(self, parameters: P) -> None:
        """Take over dynamic parameters; raise an `AgvMotionError` to refuse them."""

    def diagnose(self) -> Diagnosis:
        """Return how the node is while active."""
        return Diagnosis(OK, 'running', {})
