"""Every order of events between a few trees, up to a number of states: does floor stay apart?

The trees are the real objects (:class:`RightOfWay`) on a row of cells. What may happen next: a tree
asks for a neighbouring cell or takes its request back, hears any word told (late, again or never;
what is new is told at once), takes what it asked for, walks on, parks, notes that the others are
silent, begins another journey, believes for a while to be on another cell, or ends and starts again
with no more than names. All of these are tried from every state, breadth first, so the first breach
that is found is one of the shortest.

Bounded: words and runs of each tree are counted, and the last few words of a run stay on the way.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

from agv_motion.motion.navigation.polyline import line
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.parameters import Spec, check
from agv_motion.simulation.trials.traffic_state import (
    State,
    breached,
    clone,
    key,
    news,
    same_run,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.motion.navigation.reservations.reservation import Reservation

TRAFFIC = TrafficParameters(body=0.2, tolerance=0.1, margin=0.3, listen=0.0)
"""Two trees keep 0.9 m; cells are 1 m apart."""

LONG = 1e9
"""[s] after which everybody is silent"""


EVENTS = ('withdraw', 'park', 'silence', 'restart', 'set out', 'wrong fix')


@dataclass(frozen=True)
class SearchParameters:
    """What may happen, and how far to look."""

    cells: Annotated[tuple[int, ...], Spec('where the trees stand', '1', (0, 100))] = (0, 3)
    states: Annotated[int, Spec('most states to look at', '1', (1, 10**8))] = 20_000
    messages: Annotated[int, Spec('told by a run at most', '1', (1, 100))] = 5
    late: Annotated[int, Spec('last words of a run that are still on the way', '1', (1, 100))] = 2
    runs: Annotated[int, Spec('of each tree at most', '1', (1, 10))] = 2
    rounds: Annotated[int, Spec('in which all heard all before the search', '1', (0, 10))] = 1
    parked: Annotated[bool, Spec('all are parked before the search')] = False
    restarted: Annotated[
        bool, Spec('the first has just started again; its old words are on the way')
    ] = False
    requested: Annotated[bool, Spec('all ask for a cell beside them before the search')] = False
    events: Annotated[tuple[str, ...], Spec('that may happen', choices=EVENTS)] = EVENTS[:4]

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


_Act = Callable[[RightOfWay], object]

SETTLES = 'settles'


class SearchOutcome(NamedTuple):
    """What a search came to."""

    states: int
    """different ones that were looked at"""
    granted: int
    """steps in which a tree took floor: a search in which nobody moves says nothing"""
    breach: tuple[str, ...]
    """the events that lead to floor held by two; empty if there are none"""
    complete: bool
    """whether there was nothing left to look at"""


class Search:
    """The states of a few trees, and the steps between them."""

    def __init__(self, parameters: SearchParameters | None = None) -> None:
        """Put the trees on their cells, and let them hear each other as often as asked for."""
        self.parameters = given = parameters or SearchParameters()
        self._names = [f'tree_{i}' for i in range(len(given.cells))]
        self._last_cell = max(given.cells)
        self._granted = 0
        trees = tuple(
            self._new(name, (float(cell), 0.0), 1)
            for name, cell in zip(self._names, given.cells, strict=True)
        )
        start = State(trees, tuple(map(key, trees)), ())
        for _ in range(given.rounds):
            start = self._talk(start)
        if given.parked:
            for i in range(len(trees)):
                start = self._act(start, i, lambda one: one.park())
            start = self._talk(self._talk(start))
        if given.restarted:
            again = self._new(self._names[0], start.trees[0].held[0], 2)
            start = self._put(start, 0, again)
        for i, tree in enumerate(start.trees if given.requested else ()):
            x = tree.held[0][0]
            piece = ((x, 0.0), (x + (1.0 if i == 0 else -1.0), 0.0))
            start = self._act(start, i, partial(RightOfWay.request, piece=piece))
        self._start = start
        self._before = {tree.name: tree._number for tree in start.trees}  # noqa: SLF001

    def run(self) -> SearchOutcome:
        """Look at all states that can be reached, the nearest first."""
        queue: deque[tuple[State, tuple[str, ...]]] = deque([(self._start, ())])
        seen = {self._start.key()}
        while queue:
            state, past = queue.popleft()
            for event, following in self._steps(state):
                if event.endswith(SETTLES) and breached(following, TRAFFIC.clearance):
                    return SearchOutcome(len(seen), self._granted, (*past, event), complete=False)
                found = following.key()
                if found in seen:
                    continue
                if len(seen) >= self.parameters.states:
                    return SearchOutcome(len(seen), self._granted, (), complete=False)
                seen.add(found)
                queue.append((following, (*past, event)))
        return SearchOutcome(len(seen), self._granted, (), complete=True)

    # What may happen next

    def _steps(self, state: State) -> Iterator[tuple[str, State]]:
        for i, tree in enumerate(state.trees):
            told = tree._number - (self._before[tree.name] if tree.run == 1 else 0)  # noqa: SLF001
            if told >= self.parameters.messages:
                continue
            events = (*self._moves(tree), *self._messages(tree, state), *self._troubles(tree))
            for event, act in events:
                yield f'{tree.name} {event}', self._act(state, i, act)
            if 'restart' in self.parameters.events and tree.run < self.parameters.runs:
                for place in {tree.held[0], tree.held[-1]}:
                    again = self._new(tree.name, place, tree.run + 1)
                    yield f'{tree.name} starts again at {place[0]:.0f}', self._put(state, i, again)

    def _moves(self, tree: RightOfWay) -> Iterator[tuple[str, _Act]]:
        if tree.requested:
            yield SETTLES, self._settle
        elif len(tree.held) == 1:
            x = tree.held[0][0]
            for cell in (x - 1.0, x + 1.0):
                if 0.0 <= cell <= self._last_cell:
                    yield (
                        f'asks for {cell:.0f}',
                        partial(RightOfWay.request, piece=((x, 0.0), (cell, 0.0))),
                    )
        if len(tree.held) > 1:
            yield 'walks', lambda one: one.pass_by(one.ahead)

    def _messages(self, tree: RightOfWay, state: State) -> Iterator[tuple[str, _Act]]:
        for reservation in state.mail:
            if reservation.name != tree.name:
                event = 'hears {} {}:{}'.format(reservation.name, *reservation.message_id)
                yield event, partial(RightOfWay.receive, reservation=reservation, now=0.0)

    def _troubles(self, tree: RightOfWay) -> Iterator[tuple[str, _Act]]:
        events = self.parameters.events
        if 'withdraw' in events and tree.requested:
            yield 'withdraws', lambda one: one.withdraw()
        if 'park' in events and not tree.parked:
            yield 'parks', lambda one: one.park()
        if 'silence' in events:
            yield 'misses all', _miss_all
        if 'set out' in events:
            yield 'sets out', lambda one: one.set_out()
        if 'wrong fix' in events:
            yield from _wrong_fixes(tree)

    # Plumbing

    def _new(self, name: str, place: Point, run: int) -> RightOfWay:
        return RightOfWay(name, place, TRAFFIC, run, known=self._names)

    def _settle(self, tree: RightOfWay) -> None:
        before = len(tree.held)
        tree.settle(0.0)
        self._granted += len(tree.held) > before

    def _act(self, state: State, i: int, act: _Act) -> State:
        """Return what comes of ``act`` of tree ``i``, which tells at once what is new."""
        tree = clone(state.trees[i])
        act(tree)
        return self._put(state, i, tree)

    def _put(self, state: State, i: int, tree: RightOfWay) -> State:
        mail, before = state.mail, tree.__dict__.copy()
        reservation = tree.reservation(0.0)
        if news(reservation, mail):  # whether and when it is heard is another matter
            mail = self._posted(mail, reservation)
        else:
            tree.__dict__ = before
        trees = (*state.trees[:i], tree, *state.trees[i + 1 :])
        return State(trees, (*state.keys[:i], key(tree), *state.keys[i + 1 :]), mail)

    def _posted(
        self, mail: tuple[Reservation, ...], reservation: Reservation
    ) -> tuple[Reservation, ...]:
        """Return ``mail`` with one more word; older ones of that run than the last few are lost."""
        same = [old for old in mail if same_run(old, reservation)]
        lost = same[: max(len(same) + 1 - self.parameters.late, 0)]
        return (*(old for old in mail if old not in lost), reservation)

    def _talk(self, state: State) -> State:
        """Return what comes of it when every tree hears every other's last word."""
        for i in range(len(state.trees)):
            state = self._put(state, i, clone(state.trees[i]))
        last = {reservation.name: reservation for reservation in state.mail}
        for i, tree in enumerate(state.trees):
            for reservation in last.values():
                if reservation.name != tree.name:
                    state = self._act(
                        state, i, partial(RightOfWay.receive, reservation=reservation, now=0.0)
                    )
        return state


def _miss_all(tree: RightOfWay) -> None:
    tree.peers.judge(LONG, line(tree.held), tree._moved_since)  # noqa: SLF001


def _wrong_fixes(tree: RightOfWay) -> Iterator[tuple[str, _Act]]:
    """A tree that believes to be elsewhere, and believes it never for long enough to be sure."""
    x = tree.held[0][0]
    if tree.doubt is None:
        for cell in (x - 1.0, x + 1.0):
            yield (
                f'believes to be at {cell:.0f}',
                partial(RightOfWay.locate, place=(cell, 0.0), now=0.0),
            )
        return
    at_home = tree.doubt.before[0]
    if tree.doubt.places[0] != at_home:
        yield 'believes to be back', partial(RightOfWay.locate, place=at_home, now=0.0)
    else:
        yield 'is sure', partial(RightOfWay.locate, place=at_home, now=LONG)
