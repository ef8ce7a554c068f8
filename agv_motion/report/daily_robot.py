"""A day of one robot, gathered message by message: where it went, what it did, what it drank."""

from __future__ import annotations

from math import hypot, isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.dashboard.core.alerts import AlertBook, PlainLink
from agv_motion.explanation.decision import DECIDERS
from agv_motion.explanation.evidence import report_of
from agv_motion.report.litres import LitresDrunk

if TYPE_CHECKING:
    from agv_motion.dashboard.core.alerts import Alert
    from agv_motion.explanation.evidence import Report

STRIDE = 0.1
"""[m] Steps of the trail: shorter ones are noise of the pose, and no way."""

LONGEST_GAP = 600.0
"""[s] Over a longer one nobody knows what was."""

MOST_POINTS = 20_000
"""of a trail, and of goals"""

MOST_PROBES = 16


class Span(NamedTuple):
    """A time in which a robot did one thing for one reason; seconds since 1970."""

    begin: float
    end: float
    activity: str
    because: str
    sentence: str
    """as it was told first"""

    @property
    def duration(self) -> float:
        """How long it was [s]."""
        return self.end - self.begin


class Spans:
    """What lasts, told again and again, as spans."""

    def __init__(self) -> None:
        """Begin without one."""
        self.spans: list[Span] = []

    def add(self, time: float, activity: str, because: str, sentence: str) -> None:
        """Note what is so at ``time`` [s]."""
        last = self.spans[-1] if self.spans else None
        if last is not None and 0.0 <= time - last.end <= LONGEST_GAP:
            self.spans[-1] = last = last._replace(end=time)
            if (last.activity, last.because) == (activity, because):
                return
        self.spans.append(Span(time, time, activity, because, sentence))

    def totals(self) -> dict[str, float]:
        """Return for how long each activity lasted [s], the longest first."""
        found: dict[str, float] = {}
        for span in self.spans:
            found[span.activity] = found.get(span.activity, 0.0) + span.duration
        return dict(sorted(found.items(), key=lambda item: -item[1]))


class ProbeDay:
    """A day of one probe."""

    def __init__(self, name: str) -> None:
        """Know of no reading."""
        self.name, self.signal = name, ''
        self.conditions = Spans()
        self.drunk: float | None = None
        """[m] that is [m3] of water through [m2] of sapwood; None: no flux was ever known"""
        self._last: tuple[float, float] | None = None

    def add(self, time: float, report: Report) -> None:
        """Take up what the node of the probes says at ``time`` [s]."""
        condition = report.values.get(f'{self.name} condition', '')
        self.signal = report.values.get(f'{self.name} signal', self.signal)
        self.conditions.add(time, condition, '', '')
        flux = report.number(f'{self.name} flux density [m/s]')
        if flux is None:
            self._last = None
            return
        self.drunk = self.drunk or 0.0
        if self._last is not None and 0.0 < time - self._last[0] <= LONGEST_GAP:
            self.drunk += 0.5 * (flux + self._last[1]) * (time - self._last[0])
        self._last = time, flux


class GoalOfDay(NamedTuple):
    """Where it was to go."""

    time: float
    x: float
    y: float


class RobotDay:
    """What one robot did in a day."""

    def __init__(self, name: str) -> None:
        """Know nothing but its name."""
        self.name = name
        self.zone = ''
        """as JSON; the last that was told; empty: none was"""
        self.trail: list[tuple[float, float]] = []
        self.walked = 0.0
        """[m]"""
        self.goals: list[GoalOfDay] = []
        self.doing, self.drivers = Spans(), Spans()
        self.probes: dict[str, ProbeDay] = {}
        self.has_reasons = False
        """whether `why` was recorded: without it there are no alerts"""
        self.no_numbers = 0
        """poses, goals and amounts that held NaN or infinity"""
        self.litres = LitresDrunk()
        self._alerts = AlertBook()
        self._decider = ''

    def alerts(self) -> list[Alert]:
        """Return the alerts of the day, the first one first."""
        return self._alerts.alerts()[::-1]

    def drunk(self) -> float | None:
        """Return what it drank: the mean over the probes that tell [m3 of water per m2 sapwood]."""
        told = [probe.drunk for probe in self.probes.values() if probe.drunk is not None]
        return sum(told) / len(told) if told else None

    # What is heard of it

    def add_place(self, place: Any) -> None:
        """Take a place of the robot: a point with x and y [m]."""
        x, y = float(place.x), float(place.y)
        if not (isfinite(x) and isfinite(y)):
            self.no_numbers += 1
        elif not self.trail:
            self.trail.append((x, y))
        elif (step := hypot(x - self.trail[-1][0], y - self.trail[-1][1])) >= STRIDE:
            self.walked += step
            self.trail.append((x, y))
            if len(self.trail) > MOST_POINTS:
                self.trail = self.trail[::2]

    def add_goal(self, time: float, place: Any) -> None:
        """Take a goal [m]."""
        x, y = float(place.x), float(place.y)
        if not (isfinite(x) and isfinite(y)):
            self.no_numbers += 1
        elif len(self.goals) < MOST_POINTS:
            self.goals.append(GoalOfDay(time, x, y))

    def add_litres(self, vector: Any) -> None:
        """Take what it drank since midnight: a vector of value, low and high [l]."""
        if not self.litres.add(float(vector.x), float(vector.y), float(vector.z)):
            self.no_numbers += 1

    def add_driver(self, time: float, message: Any) -> None:
        """Take who drives."""
        report = report_of(message, time)
        self.drivers.add(time, report.values.get('driver', ''), '', report.message)

    def add_reasons(self, time: float, message: Any) -> None:
        """Take a chain of reasons."""
        self.has_reasons = True
        links = []
        for status in message.status:
            level, sentence, values, _ = report_of(status, time)
            if status.name != 'headline':
                because = values.get('because', '')
                links.append(PlainLink(str(status.name), level.name, sentence, because))
        self._alerts.update(self.name, links, time)

    def add_report(self, node: str, time: float, status: Any) -> None:
        """Take what a node of it says of itself."""
        report = report_of(status, time)
        if node == 'granier_probe':
            for i in range(1, MOST_PROBES + 1):
                if (name := f'probe_{i}') + ' condition' in report.values:
                    self.probes.setdefault(name, ProbeDay(name)).add(time, report)
        activity = report.values.get('activity', '')
        if node in DECIDERS and activity and self._decides(node, activity):
            because = report.values.get('because', '')
            self.doing.add(time, activity, because, report.message)

    def _decides(self, node: str, activity: str) -> bool:
        """Return whether a node counts: that which drives, else the first that was heard."""
        if not self._decider or activity in {'driving', 'turning', 'walking'}:
            self._decider = node
        return node == self._decider
