"""The navigator of a tree among others: which path it takes, when it waits, when it gives way.

Safety is the matter of :class:`RightOfWay`; what is here only decides what to ask for, so a defect
here can cost time but no bark. Five habits let all go on:

- Who set out first goes first; the others keep off the next metres of its path.
- Who cannot go on takes a way round what the others hold.
- Who cannot go on and stands in the way of one that goes first walks to a refuge, and out of a
  narrow passage backwards if need be.
- Who is blocked for long looks for another goal, and is then the youngest.
- Who goes first, yet is blocked for longer still, and has only that goal, becomes the youngest:
  where the others found no refuge, it may.

The oldest journey has everybody's way out of it, and each journey becomes the oldest.
"""

from __future__ import annotations

from math import hypot, inf
from typing import TYPE_CHECKING

import shapely

from agv_motion.errors import GeometryError
from agv_motion.motion.navigation.navigator import Guidance
from agv_motion.motion.navigation.path_follower import CORNER_REACH, CORNER_SLACK, Waypoints
from agv_motion.motion.navigation.polyline import ROUNDING, Path, cut, joined, length, line, nearest
from agv_motion.motion.navigation.reservations.detour import Detours
from agv_motion.motion.navigation.reservations.needs import ARRIVED, COURTESY, Needs
from agv_motion.motion.navigation.reservations.reservation import IDLE, Answer, Reservation
from agv_motion.motion.navigation.reservations.separation import apart

if TYPE_CHECKING:
    from agv_motion.motion.navigation.path_planner import PathPlanner
    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay

STRETCH = 1.0
"""[m] asked for at a time, and held ahead: a minute's walk at the most."""

STUCK = 5.0
"""[s] without floor ahead after which another path is sought, and time between two searches."""

LONG_WAY = 60.0
"""[s] A detour of more than twice the length is taken only when stuck for this time."""

CHECK_PERIOD = 1.0
"""[s] between two looks whether any path leads to the goal: the tree may have been carried."""


class SharedNavigator:
    """Takes one tree to its goals along floor that it holds."""

    def __init__(self, right: RightOfWay, planner: PathPlanner) -> None:
        """Stand where ``right`` says.

        Args:
            right: What the tree holds.
            planner: The paths in its zone.

        """
        self.right, self._needs = right, Needs(right)
        self.patience = right.parameters.patience
        self._spare = right.parameters.tolerance / 2.0  # the other half is for errors of position
        self._planner, self._detours = planner, Detours(planner.zone, self._needs)
        self._waypoints = Waypoints(planner.zone, min(CORNER_REACH, self._spare), CORNER_SLACK)
        self._goal: Point | None = None
        self._checked: tuple[Point | None, float] = (None, -inf)
        self._failure: GeometryError | None = None
        self._route: Path = ()
        self._after_piece: Path = ()
        self._yielding = False
        self._reason = self._waits_for = ''
        self._going_at = self._planned_at = self._counted_at = 0.0

    def reservation(self, now: float) -> Reservation:
        """Return what to tell the others, every second or two and after every step of interest."""
        right = self.right
        return right.reservation(now, joined(right.held, self._route))

    def navigate(
        self, goal: Point | None, here: Point, now: float, *, straight: bool = False
    ) -> Guidance:
        """Return how to go on to ``goal``, as far as others let the tree.

        See :meth:`Navigator.navigate`. ``now`` is of the tree's steady clock [s]. Where no path
        leads to the goal, the tree has none, and gives way.
        """
        failure = None
        if goal is not None and not straight:
            failure = self._check(goal, here, now)
        if failure is not None:
            goal = None
        guidance = self._go_on(goal, here, now)
        if goal is None and guidance.target is None:
            return Guidance(failure=failure)
        return guidance._replace(path=(here, *guidance.path), failure=failure)

    def _check(self, goal: Point, here: Point, now: float) -> GeometryError | None:
        """Return why no path at all leads from ``here`` to ``goal``; looked at now and then."""
        checked, at = self._checked
        if goal != checked or not 0.0 <= now - at < CHECK_PERIOD:
            self._checked, self._failure = (goal, now), self._planner.failure(here, goal)
        return self._failure

    def _go_on(self, goal: Point | None, here: Point, now: float) -> Guidance:
        """Ask for floor ahead where there is little left, and go on along what is held."""
        right = self.right
        along = self._track(here, now)
        if right.doubt is not None:
            blocked = now - self._going_at if goal is not None and self._goal is not None else 0.0
            return Guidance(None, (here,), f'stands: {right.obstacle(now)}', blocked)
        if goal != self._goal or self._has_waited(now):
            self._set_out(goal, along, now)
            along = 0.0
        self._settle(now)
        ahead = right.ahead - along
        stuck = now - self._going_at
        if not right.requested and ahead <= ARRIVED and min(stuck, now - self._planned_at) >= STUCK:
            self._plan_again(along, stuck, now)
            along, ahead = 0.0, 0.0
        if not right.requested and ahead < STRETCH:
            self._request()
            self._settle(now)
        return self._follow(here, along, now)

    def _follow(self, here: Point, along: float, now: float) -> Guidance:
        """Return how far the tree may go on the path it holds, as far as the last guard lets it."""
        right = self.right
        path = joined(self._waypoints.ahead(here, cut(right.held, along)[1]), self._route)
        holds = right.ahead - along > ARRIVED
        free = self._needs.step((here, path[0]), self._spare)
        obstacle = right.obstacle(now)
        walks = holds and not obstacle and length(free.path) > ROUNDING
        self._count(now, walks=walks and not self._yielding)
        if holds and free.by and not walks:
            self._let_go(along)
            self._reason, self._waits_for = f'waits for {free.by}, which is on its floor', free.by
        blocked = now - self._going_at if self._goal is not None else 0.0
        if not walks:
            reason = f'stands: {obstacle}' if obstacle else self._reason
            return Guidance(None, path, reason, blocked, waits_for=self._waits_for)
        reason = 'gives way' if self._yielding else ''
        return Guidance(free.path[-1], path, reason, blocked, self._yielding)

    def _count(self, now: float, *, walks: bool) -> None:
        """Count for how long the tree could not go on; waiting for an answer does not count.

        Else a tree on a slow network would take back each request before its answer can come.
        """
        if walks:
            self._going_at = now
        elif self.right.requested:
            self._going_at = min(self._going_at + max(now - self._counted_at, 0.0), now)
        self._counted_at = now

    def rest(self, here: Point, now: float, *, fresh: bool = True) -> None:
        """Hold nothing but the place where the tree is: it does not move for a while.

        Args:
            here: Where the centre is in the map [m].
            now: Time of this tree's steady clock [s].
            fresh: See :meth:`RightOfWay.locate`.

        """
        self._let_go(self._track(here, now, fresh=fresh))
        self._goal = None
        self.right.set_out(IDLE)

    def park(self, here: Point, now: float) -> None:
        """Rest, and promise to stay: nobody needs to wait for an answer of this tree."""
        self.rest(here, now, fresh=False)
        self.right.park()

    def closed(self) -> shapely.Geometry:
        """Return the floor on which no goal makes sense now: occupied, or left to a silent tree."""
        bounds = self._planner.zone.bounds
        sides = [
            peer.sides.closed(bounds, self._needs.clearance(peer))
            for peer in self.right.peers
            if peer.sides is not None
        ]
        return shapely.union_all([self._detours.occupied(), *sides])

    # Where the tree is on the path it holds

    def _track(self, here: Point, now: float, *, fresh: bool = True) -> float:
        """Return how far along the path it holds the tree is, and let go of what lies behind.

        A tree that is farther off than the tolerance stands, and has another path to find once it
        is sure where it is.
        """
        right = self.right
        was_sure = right.doubt is None
        if not right.locate(here, now, fresh=fresh):
            self._route, self._yielding = (), False
            return 0.0
        if not was_sure:
            self._plan()
        along, _ = nearest(right.held, here)
        passed = max(along - right.parameters.tolerance, 0.0)
        right.pass_by(passed)
        return along - passed

    def _let_go(self, along: float) -> None:
        """Hold nothing but the place reached, ask for nothing, and have no way to go."""
        self.right.pass_by(along)
        self.right.stop()
        self._route, self._yielding = (), False

    # Which path to take

    def _set_out(self, goal: Point | None, along: float, now: float) -> None:
        """Begin another journey."""
        self._let_go(along)
        self.right.set_out(IDLE if goal is None else None)
        self._goal, self._going_at, self._planned_at = goal, now, now
        self._reason, self._waits_for, self._needs.courtesy = '', '', COURTESY
        self._plan()

    def _has_waited(self, now: float) -> bool:
        """Return whether those who go after this tree have had time to get out of its way."""
        begun = self._needs.last_begun()
        if begun is None:
            return False
        return now - max(begun, self._going_at) > 2.0 * self.right.parameters.patience

    def _plan(self) -> None:
        """Take the shortest path, unless it leads past a tree that stands there."""
        self._go_direct()
        path = line(self._route)
        if not all(apart(path, *need) for need in self._needs.of_all(standing=True)):
            self._take_detour(length(self._route))

    def _plan_again(self, along: float, stuck: float, now: float) -> None:
        """Find a way round, or out of the way of who goes first."""
        self._let_go(along)
        self._planned_at = now
        place, goal = self.right.held[0], self._goal
        far = 0.0
        if goal is not None and stuck < LONG_WAY:
            far = hypot(goal[0] - place[0], goal[1] - place[1])
        if not self._take_detour(far or inf) and not self._give_way():
            self._go_direct()

    def _go_direct(self) -> None:
        """Take the shortest path there is, whoever may be on it."""
        if self._goal is None:
            return
        try:
            self._route = tuple(self._planner.path(self.right.held[0], self._goal))
        except GeometryError as error:
            self._reason = str(error)

    def _take_detour(self, direct: float) -> bool:
        """Take the shortest path past all that others need; return whether there is one."""
        if self._goal is None:
            return False
        path = self._detours.past_all(self.right.held[0], self._goal)
        if path is None or length(path) > 2.0 * direct + 2.0:
            return False
        self._route, self._yielding = path, False
        return True

    def _give_way(self) -> bool:
        """Walk to a refuge if the tree stands in the way of one that goes first; return whether."""
        path = self._detours.to_refuge(self.right.held[0])
        if path is None:
            return False
        self._route, self._yielding = path, True
        self._needs.courtesy = inf
        return True

    # What to ask for

    def _request(self) -> None:
        """Ask for the next stretch of the route, as far as it is free by all that is known."""
        if len(self._route) < 2:
            return
        piece, blocker = self._needs.leave(
            cut(self._route, STRETCH)[0], ARRIVED, plans=not self._yielding
        )
        if length(piece) > ARRIVED:
            self._after_piece = cut(self._route, length(piece))[1]
            self.right.request(piece)
        else:
            self._reason, self._waits_for = f'waits for {blocker}', blocker

    def _settle(self, now: float) -> None:
        right = self.right
        if not right.requested:
            return
        ruling = right.settle(now)
        if ruling.answer is Answer.GRANTED:
            self._route = self._after_piece
            self._reason = self._waits_for = ''
        else:
            self._reason, self._waits_for = str(ruling), ruling.name
            if ruling.answer is Answer.TAKEN:
                right.withdraw()
