"""Acts of people, from the click to what the robot reports of it."""

from __future__ import annotations

import asyncio
import secrets
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.core.outcomes import is_done
from agv_motion.dashboard.server.fleet import NoAnswerError, RefusedError

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.dashboard.server.fleet import Fleet
    from agv_motion.dashboard.server.live import Hub

ANSWER = 1.5
"""[s] after which a robot has not answered; its own limit of 1 s comes first"""
COMING_TRUE = 15.0
"""[s] within which what was accepted must be reported"""
MOST = 200
"""acts that are under way at once"""


@dataclass(eq=False)
class _Act:
    id: str
    robot: str
    action: str
    arguments: dict[str, Any]
    words: str = ''
    then: Callable[[], None] | None = None
    """called when the robot has agreed"""
    begun: float = 0.0
    """[s] on the clock of the board"""
    end: float = field(default_factory=lambda: time.monotonic() + ANSWER + COMING_TRUE)


class Acts:
    """Sends what is asked to the robots, and tells everybody how it ends."""

    def __init__(self, fleet: Fleet, hub: Hub) -> None:
        """Begin with no act.

        Args:
            fleet: The robots.
            hub: Tells the outcomes.

        """
        self._fleet, self._hub = fleet, hub
        self._pending: list[_Act] = []
        self._tasks: set[asyncio.Task[None]] = set()
        hub.at_each_look.append(self.look)
        hub.busy = lambda: bool(self._pending or self._tasks)

    @property
    def full(self) -> bool:
        """Whether so many are under way that no other can begin."""
        return len(self._pending) + len(self._tasks) >= MOST

    def begin(
        self, robots: list[str], action: str, arguments: dict[str, Any],
        then: Callable[[], None] | None = None,
    ) -> str:  # fmt: skip
        """Ask robots for something; return the id under which the outcomes are told.

        Args:
            robots: Their names; one that is empty is meant by what all share.
            action: What is asked.
            arguments: With what.
            then: Called when a robot has agreed.

        """
        number = secrets.token_hex(8)
        for robot in robots:
            act = _Act(number, robot, action, arguments, then=then, begun=self._fleet.now())
            task = asyncio.create_task(self._run(act))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)
        return number

    def look(self, now: float) -> None:
        """Find out which acts have come true, as of ``now`` [s] on the clock of the board."""
        pending, self._pending = self._pending, []
        for act in pending:
            robot = self._fleet.board.robots.get(act.robot)
            done = None if robot is None else is_done(
                robot, act.action, act.arguments, act.begun, now)  # fmt: skip
            if done or done is None:
                self._tell(act, 'done', act.words)
            elif time.monotonic() > act.end:
                words = f'{act.words}; but that has not been reported in {COMING_TRUE:g} s'
                self._tell(act, 'no_answer', words.removeprefix('; '))
            else:
                self._pending.append(act)

    async def _run(self, act: _Act) -> None:
        """Ask the robot, and wait for its answer."""
        self._tell(act, 'sent', '')
        try:
            act.words = await asyncio.wait_for(
                self._fleet.act(act.robot, act.action, act.arguments), ANSWER
            )
        except RefusedError as error:
            self._tell(act, 'refused', str(error))
        except (NoAnswerError, asyncio.TimeoutError) as error:
            self._tell(act, 'no_answer', str(error) or f'no answer in {ANSWER:g} s')
        else:
            if act.then is not None:
                act.then()
            self._pending.append(act)

    def _tell(self, act: _Act, state: str, text: str) -> None:
        self._hub.tell({
            'id': act.id, 'robot': act.robot, 'action': act.action, 'state': state, 'text': text,
        })  # fmt: skip
