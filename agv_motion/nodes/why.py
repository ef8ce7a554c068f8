"""Node `why`: what a robot says of itself in, the chain of reasons for what it does out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.qos import QoSProfile

from agv_motion.explanation.evidence import Evidence
from agv_motion.explanation.explainer import Explainer
from agv_motion.ros.diagnosis import OK, Diagnosis
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import LATCHED
from agv_motion.ros.run import run

if TYPE_CHECKING:
    from agv_motion.explanation.link import Chain, Link
    from agv_motion.ros.port import Port

REPORTS = QoSProfile(depth=50)
"""All nodes of all robots speak on one topic."""

LOOK = 0.2
"""[s] within which a new headline is told"""

EVERY = 1.0
"""[s] after which the chain is told again"""


@dataclass(frozen=True)
class WhyParameters:
    """None: it listens and tells."""


class Why(PlainNode[WhyParameters]):
    """`/diagnostics` and `driver` -> `why`: once a second, and when the headline changes.

    It commands nothing, and nothing that commands listens to it.
    """

    name = 'why'
    takes = WhyParameters

    def __init__(self, port: Port, parameters: WhyParameters) -> None:
        """Open the topics."""
        super().__init__(port, parameters)
        self._begin_anew()
        self._publisher = port.publisher(DiagnosticArray, 'why', LATCHED, sole=True)
        port.listen(DiagnosticStatus, 'driver', self._on_driver, LATCHED)
        port.listen(DiagnosticArray, '/diagnostics', self._on_diagnostics, REPORTS)
        port.every(LOOK, self._look, steady=True)

    def begin(self) -> None:
        """Know nothing of before."""
        self._begin_anew()

    def _begin_anew(self) -> None:
        self._evidence, self._explainer = Evidence(self.port.namespace), Explainer()
        self._headline, self._told_at, self._due = '', 0.0, True

    def diagnose(self) -> Diagnosis:
        """Tell the headline: how the robot is, its own nodes say."""
        return Diagnosis(OK, self._headline or 'nothing is heard of the robot yet', {})

    def _on_driver(self, message: DiagnosticStatus) -> None:
        self._evidence.receive_driver(message, self.port.steady_seconds())
        self._look()

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self._evidence.receive(message, self.port.steady_seconds())

    def _look(self) -> None:
        now = self.port.steady_seconds()
        if not (self._evidence.nodes or self._evidence.driver):
            return
        chain = self._explainer.explain(self._evidence, now, self.port.seconds())
        if chain.headline == self._headline and 0.0 <= now - self._told_at < EVERY:
            return
        self._headline, self._told_at = chain.headline, now
        self._publisher.publish(self._message(chain))

    def _message(self, chain: Chain) -> DiagnosticArray:
        message = DiagnosticArray()
        self.port.stamp(message)
        cause = chain.cause
        head = cause._replace(name='headline', level=chain.level, sentence=chain.headline)
        message.status = [status_of(link) for link in (head, *chain.links)]
        message.status[0].values.append(KeyValue(key='cause', value=cause.name))
        return message


def status_of(link: Link) -> DiagnosticStatus:
    """Return a link as it is told; what is not known is empty."""
    values = {
        'age [s]': '' if link.age is None else f'{link.age:.1f}',
        'since': '' if link.since is None else f'{link.since:.1f}',
        'remedy': link.remedy,
        'limit': link.limit,
        'because': link.because,
    }
    return DiagnosticStatus(
        level=bytes([link.level]),
        name=link.name,
        message=link.sentence,
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )


def main() -> None:
    """Run the node."""
    run(Why)


if __name__ == '__main__':
    main()
