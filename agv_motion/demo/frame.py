"""One frame for every demo: its nodes on one executor, a recorder, a live picture, and the end.

A `Scenario` says what sets one demo apart; `Demo` runs it. Afterwards `read`, `tell` and `draw` of
the scenario make what is printed and drawn, from the bag alone.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Generic

import rclpy
from rich.console import Group
from rich.live import Live
from std_msgs.msg import String

from agv_motion.demo.explained import robots, why_nodes, why_topics
from agv_motion.demo.map_view import Room
from agv_motion.demo.readout import bar
from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
from agv_motion.demo.scenario import DemoGraph, R, Scenario
from agv_motion.demo.standard_error import apart
from agv_motion.ros.context import begin_context
from agv_motion.ros.run import spin, start
from agv_motion.ros.stop import Stop

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from rich.console import Console, RenderableType


REFRESH = 0.25
"""[s] between two pictures of the live view"""

LEISURE = 4.0
"""How many times longer than a picture took the next one waits at least: robots go first"""


def explained(graph: DemoGraph) -> DemoGraph:
    """Return a graph with a node `why` beside each robot, told and recorded too."""
    namespaces = robots(graph.nodes)
    return graph._replace(
        nodes=[*graph.nodes, *why_nodes(namespaces)],
        topics=[*graph.topics, *why_topics(namespaces)],
    )


def next_after(begun: float, done: float) -> float:
    """Return when the next picture is due [s] after one that took from ``begun`` to ``done``.

    A slow terminal, or a busy machine, has fewer pictures, and does not hold up the robots.
    """
    return max(begun + REFRESH, done + LEISURE * (done - begun))


class Demo(Generic[R]):
    """Runs a scenario, and records it: a context, at whose end the ROS graph is left."""

    def __init__(self, scenario: Scenario[R], bag: Path) -> None:
        """Let the scenario be recorded into the folder ``bag``, which must be new."""
        self.scenario = scenario
        self._bag = bag
        self._begun = self._ended = 0.0

    def __enter__(self) -> Demo[R]:
        """Make and start all nodes."""
        begin_context()
        self._stop = Stop()
        try:
            self.graph = explained(self.scenario.build())
            for node in self.graph.nodes:
                start(node)
            leader = self.graph.leader.plain
            topics = [*self.graph.topics, RecordedTopic('/mark', String)]
            self.recorder = DemoRecorder(self._bag, topics, lambda: leader.nanoseconds)
        except BaseException:
            rclpy.try_shutdown()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the graph."""
        rclpy.try_shutdown()

    @property
    def elapsed(self) -> float:
        """Simulated time that has passed [s]."""
        return float(self.graph.leader.plain.elapsed)

    @property
    def factor(self) -> float:
        """Simulated over real time, as achieved."""
        return self.elapsed / max((self._ended or time.perf_counter()) - self._begun, 1e-9)

    def run(self, console: Console, *, live: bool = True) -> None:
        """Run until the scenario is over, or until a signal; ``live``: show how it goes.

        Raises:
            SourceError: The disk did not take everything; what it took is a whole bag.

        """
        self._begun = time.perf_counter()
        if live and console.is_terminal:
            self._run_live(console)
        else:
            self._spin(lambda: self._finished(console))
        self._ended = time.perf_counter()
        self.recorder.close()

    def _run_live(self, console: Console) -> None:
        """Run with a picture; what nodes log stands above it."""
        picture, next_picture = self._picture(console), 0.0
        with (
            Live(console=console, auto_refresh=False, transient=True) as screen,
            apart(lambda text: console.print(text, highlight=False, soft_wrap=True)) as show_log,
        ):

            def finished() -> bool:
                nonlocal next_picture
                show_log()
                now = time.perf_counter()
                if now >= next_picture:
                    screen.update(picture(), refresh=True)
                    next_picture = next_after(now, time.perf_counter())
                return self._finished(console)

            self._spin(finished)

    def _finished(self, console: Console) -> bool:
        over = self.scenario.over(self.elapsed, console.print)
        return over or self._stop.requested or bool(self.recorder.failure)

    def idle(self, seconds: float) -> float:
        """Run for ``seconds`` of real time; return the processor time per second."""
        used, until = time.process_time(), time.perf_counter() + seconds
        self._spin(lambda: time.perf_counter() > until)
        load = (time.process_time() - used) / seconds
        self.recorder.close()
        return load

    def _spin(self, until: Callable[[], bool]) -> None:
        spin([self.recorder, *self.graph.others, *self.graph.nodes], until)

    def _picture(self, console: Console) -> Callable[[], RenderableType]:
        """Return what makes the live picture: that of the scenario, and a bar below."""
        view = self.scenario.view(self.recorder)

        def picture() -> RenderableType:
            columns, rows = console.size
            room = Room(columns, rows - 1 - bool(self.scenario.doing))
            parts: list[RenderableType] = []
            if view is not None:
                parts.append(view.draw(self.graph.leader.plain.time, self.factor, room))
            if self.scenario.doing:
                parts.append(bar(*self.scenario.progress(self.elapsed), columns))
            return Group(*parts)

        return picture
