"""What sets one demo apart: its nodes, its live picture, when it is over, what comes of its bag."""

from __future__ import annotations

from abc import ABC, abstractmethod
from math import inf
from typing import TYPE_CHECKING, Any, ClassVar, Generic, NamedTuple, Protocol, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    from rclpy.lifecycle import LifecycleNode
    from rich.console import RenderableType

    from agv_motion.bag.reader import BagReader
    from agv_motion.demo.map_view import Room
    from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
    from agv_motion.ros.live_node import LiveNode

R = TypeVar('R')


class DemoGraph(NamedTuple):
    """The nodes of a demo, and what is kept of what they say."""

    nodes: Sequence[LiveNode[Any]]
    """of this package; they leave their outputs safe in this order"""
    leader: LiveNode[Any]
    """the simulator among them whose time is that of the demo"""
    topics: Sequence[RecordedTopic]
    others: Sequence[LifecycleNode] = ()
    """nodes that are none of this package's, such as one that drives"""


class LiveView(Protocol):
    """A picture of the demo as it runs."""

    def draw(self, now: float, factor: float, room: Room) -> RenderableType:
        """Return the picture at simulated ``now`` [s], passing ``factor`` times real time."""


class DemoSoFar(Protocol):
    """A demo that runs or has run, as its scenario may look at it."""

    recorder: DemoRecorder

    @property
    def elapsed(self) -> float:
        """Simulated time that has passed [s]."""

    @property
    def factor(self) -> float:
        """Simulated over real time, as achieved."""


class Scenario(ABC, Generic[R]):
    """What sets one demo apart; ``R`` is what it reads back from its bag."""

    figure: ClassVar[str]
    """file name of the picture"""
    doing: ClassVar[str] = ''
    """word beside the bar that shows how far the demo is; without one there is no bar"""

    def __init__(self, seconds: float = inf) -> None:
        """Let the demo last so many simulated seconds, or until it is `over`."""
        self.seconds = seconds

    @abstractmethod
    def build(self) -> DemoGraph:
        """Make the nodes; the ROS context is there."""

    def view(self, recorder: DemoRecorder) -> LiveView | None:  # noqa: ARG002 - for those that have one
        """Return the live view; there may be none."""
        return None

    def progress(self, elapsed: float) -> tuple[float, str]:
        """Return the share that is done after ``elapsed`` [s], and what the robot does."""
        return elapsed / self.seconds, self.doing

    def over(self, elapsed: float, say: Callable[[str], None]) -> bool:  # noqa: ARG002
        """Return whether the demo ends after ``elapsed`` [s]; asked again and again as it runs."""
        return elapsed >= self.seconds

    def last_word(self, demo: DemoSoFar) -> str:  # noqa: ARG002 - for those that have one
        """Return how it ended, where there is more to say than the bag tells."""
        return ''

    @property
    def succeeded(self) -> bool:
        """Whether the robot did what it was to do."""
        return True

    @abstractmethod
    def read(self, bag: BagReader) -> R:
        """Read the bag of the demo back."""

    @abstractmethod
    def tell(self, run: R, demo: DemoSoFar) -> Iterator[RenderableType]:
        """Yield what is to be printed of a run."""

    @abstractmethod
    def draw(self, run: R, path: Path) -> bool:
        """Draw a run into one picture; return whether there was anything to draw."""
