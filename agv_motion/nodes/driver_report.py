"""What `arbiter` tells: who drives and why the others do not, and whether the wheels must stand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from std_msgs.msg import Bool

from agv_motion.arbitration.choice import Verdict
from agv_motion.arbitration.sentence import sentence, told
from agv_motion.arbitration.source import DRIVERS
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.qos import LATCHED

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.arbitration.choice import Choice, Standing
    from agv_motion.arbitration.source import TwistSource
    from agv_motion.ros.port import Port

INACTIVE = 'the arbiter is not active: nobody drives'


class DriverReport:
    """Publishes `driver` and `standstill`."""

    def __init__(self, port: Port) -> None:
        """Open both topics."""
        self._port = port
        self._driver = port.publisher(DiagnosticStatus, 'driver', LATCHED, sole=True)
        self._standstill = port.publisher(Bool, 'standstill', LATCHED, sole=True)
        self._standing: bool | None = None
        self._told: tuple[Any, ...] = ()
        """what was worth telling of the choice told last"""

    def stand(self, *, at_once: bool) -> None:
        """Tell the wheels whether they must stand, where that has changed."""
        if at_once is not self._standing:
            self._standing = at_once
            self._standstill.publish(Bool(data=at_once))

    def forget(self) -> None:
        """Tell the wheels again, whatever was told before."""
        self._standing = None

    def is_new(self, choice: Choice) -> bool:
        """Return whether a choice differs from what was told in what is worth telling at once."""
        return _matter(choice) != self._told

    def tell(self, choice: Choice) -> None:
        """Tell who drives, and take it for told."""
        self._told = _matter(choice)
        self.publish(diagnosis(choice))

    def tell_inactive(self, choice: Choice) -> None:
        """Tell that nobody drives any more, and how things stood."""
        self._told = ()
        values = diagnosis(choice).values | {'driver': 'none'}
        self.publish(Diagnosis(WARN, INACTIVE, values))

    def publish(self, found: Diagnosis) -> None:
        """Tell who drives."""
        name = f'{self._port.namespace.rstrip("/")}/{self._port.name}'
        self._driver.publish(
            DiagnosticStatus(
                level=found.level,
                name=name,
                message=found.message,
                hardware_id=name,
                values=[KeyValue(key=key, value=value) for key, value in found.values.items()],
            )
        )


def _matter(choice: Choice) -> tuple[Any, ...]:
    """Return what of a choice is worth telling at once."""
    verdicts = tuple(standing.verdict for standing in choice.standings.values())
    return choice.driver, verdicts, choice.hold


def diagnosis(choice: Choice) -> Diagnosis:
    """Return a choice as `driver` tells it: the sentence, and one value for each driver."""
    driver, hold = choice.driver, choice.hold
    values = {
        'driver': 'none' if driver is None else driver.value,
        'stop': '' if hold.stop is None else told(hold.stop),
        'lock': _listed(hold.locks),
        'lost': _listed(hold.lost),
    } | {source.value: _words(choice.standings[source]) for source in DRIVERS}
    return Diagnosis(_level(choice), sentence(choice), values)


def _level(choice: Choice) -> Any:
    if choice.hold.stop is not None:
        return ERROR
    stands_for = choice.driver and choice.standings[choice.driver].verdict
    return WARN if stands_for in {Verdict.LOST, Verdict.HOLDS} else OK


def _listed(sources: Iterable[TwistSource]) -> str:
    return ', '.join(sorted(source.value for source in sources))


def _words(standing: Standing) -> str:
    """Return a standing such as ``outranked (manual comes first), 0.10 s``."""
    waits = f' ({standing.waits_for})' if standing.waits_for else ''
    age = '' if standing.age is None else f', {standing.age:.2f} s'
    return f'{standing.verdict.value}{waits}{age}'
