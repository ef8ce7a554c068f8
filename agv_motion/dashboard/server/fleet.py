"""What the server needs of whoever knows the robots: live on a graph, or out of a bag."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from asyncio import Future

    from agv_motion.dashboard.core.board import Board
    from agv_motion.planar import Twist


class RefusedError(AgvMotionError):
    """An act that was not done, with the robot's words or ours."""


class NoAnswerError(AgvMotionError):
    """A robot that is not there, or has not answered in time."""


class Fleet(Protocol):
    """The robots, as the server sees them; all is called in the server's thread."""

    board: Board

    @property
    def robots(self) -> list[str]:
        """Names of those that were ever seen."""

    def now(self) -> float:
        """Return the time of the board [s]."""

    def act(self, robot: str, action: str, arguments: dict[str, Any]) -> Future[str]:
        """Begin an act; the future has the robot's answer in words, or why there is none.

        A `RefusedError` has the robot's words, or ours where nobody there does such a thing; a
        `NoAnswerError` tells that nobody answered in time.

        An act to which nothing answers (a topic) is done when it is sent, with no words.
        """

    async def parameters(self, robot: str) -> list[dict[str, Any]]:
        """Return the nodes of a robot: ``node``, and ``rows`` of its parameters.

        A row has name, value, default, unit, low, high, text, choices, dynamic.
        """

    def drive(self, robot: str, twist: Twist, age: float) -> None:
        """Send a twist of a person's hand once, which is ``age`` [s] old by now."""
