"""Probes whose logger or gateway publishes by MQTT: the lines of a serial logger, or JSON.

A reading counts when it is made, not when a broker hands it out: what the broker has kept, sends
twice, or brings late is told and left out.
"""

from __future__ import annotations

import re
from math import inf
from time import monotonic
from typing import TYPE_CHECKING

from agv_motion.probe.sources.line_listener import Origin
from agv_motion.probe.sources.line_reading import JSON, LineParameters, LineReader, sample_of
from agv_motion.probe.sources.logger_line import EPOCHS, cleaned
from agv_motion.probe.sources.mqtt_connection import MqttConnection
from agv_motion.probe.sources.topic_rounds import TopicRounds

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from agv_motion.probe.sources.logger_line import LoggerLine
    from agv_motion.probe.sources.mqtt_connection import MqttMessage
    from agv_motion.probe.sources.mqtt_parameters import MqttParameters
    from agv_motion.probe.sources.source import ProbeSample


class MqttSource:
    """Reads what the broker has sent, without ever waiting for it."""

    def __init__(self, parameters: MqttParameters) -> None:
        """Start without a connection; the first `read` begins it, and a thread keeps it up.

        Raises:
            ConfigurationError: paho-mqtt is missing, or password or authorities cannot be read.

        """
        self._given = given = parameters
        self._connection = MqttConnection(given)
        self._reader = LineReader(
            given,
            Origin(
                f'from {given.broker} on {list(given.topics)}',
                'look whether the logger is on, and at mqtt.topics',
                'is it of these probes, and in the form that format names?',
            ),
        )
        self._freshness = _Freshness(given)
        self._rounds = TopicRounds(len(given.fields), 0.5 * given.period)
        self._in_order = LineParameters(
            tuple(range(1, len(given.fields) + 1)),
            unit=given.unit,
            kelvin_per_millivolt=given.kelvin_per_millivolt,
        )
        self._topic = ''
        self._last_read = -inf

    @property
    def period(self) -> float:
        """Usual time between samples [s]."""
        return self._given.period

    def history(self, now: float) -> Iterable[ProbeSample]:  # noqa: ARG002 - a topic has no past
        """Return nothing: a topic remembers one message at most; use the node's state file."""
        return ()

    def read(self, now: float) -> list[ProbeSample]:
        """Return the samples of all messages that have come."""
        self._connection.start()
        for trouble in self._connection.troubles():
            self._reader.note(trouble)
        samples: list[ProbeSample] = []
        here = monotonic()
        self._reader.heard(now, something=not self._connection.subscribed)
        # none of them came before the last read, whatever the clock does between the two
        earliest, self._last_read = min(self._last_read, now), now
        for message in self._connection.messages():
            arrived = max(now - max(here - message.at, 0.0), earliest)
            samples += self._samples(message, arrived)
        samples += self._together(self._rounds.overdue(now))
        self._reader.listen(now)
        return samples

    def complaint(self) -> str:
        """Return what was unreadable, left out or missing, the first few things of it."""
        return self._reader.complaint()

    def close(self) -> None:
        """Leave the broker, and end the thread."""
        self._connection.close()

    def _samples(self, message: MqttMessage, arrived: float) -> Iterator[ProbeSample]:
        """Yield what one message tells that is new."""
        topic, texts = message.topic, self._texts(message.payload)
        if message.retained:
            self._reader.last = self._reader.last or ' '.join(texts)
            self._reader.note_once(
                'retained',
                f"the broker has kept a message on '{topic}' from before, which is of any age: "
                'left out; told once',
            )
            return
        self._reader.heard(arrived, something=True)
        for text in texts:
            line = self._reader.line(text, arrived)
            if line is None or not self._of_one_logger(topic):
                continue
            old = self._freshness.doubt(message, text, line, arrived)
            if old:
                self._reader.note(old)
            elif len(self._given.topics) == 1:
                sample = self._reader.sample(text, line)
                yield from () if sample is None else (sample,)
            else:
                yield from self._probe(topic, text, line, arrived)

    def _texts(self, payload: bytes) -> list[str]:
        """Return the lines of a payload; a JSON object is one, however it is set."""
        if self._given.format == JSON:
            return [payload.decode('utf-8', errors='replace').strip('\0 \t\r\n\ufeff')]
        return [text for line in re.split(rb'[\r\n]', payload) if (text := cleaned(line))]

    def _of_one_logger(self, topic: str) -> bool:
        """Refuse a second topic that a + or # stands for: its probes are others."""
        if len(self._given.topics) > 1:
            return True
        self._topic = self._topic or topic
        if topic != self._topic:
            self._reader.note_once(
                f'topic {topic}',
                f"'{topic}' is another logger than '{self._topic}', which came first: left out; "
                'name one of them in mqtt.topics; told once',
            )
        return topic == self._topic

    def _probe(
        self, topic: str, text: str, line: LoggerLine, arrived: float
    ) -> Iterator[ProbeSample]:
        """Yield the samples that become whole by the line of one probe."""
        probe = self._given.topics.index(topic)
        field = self._given.fields[probe]
        if field > len(line.values):
            self._reader.note(
                f"line '{text:.80}' on '{topic}' has {len(line.values)} values, field {field} is "
                'missing: check the logger, or mqtt.fields'
            )
            return
        value = line.values[field - 1]
        yield from self._together(self._rounds.add(probe, line.time, value, arrived))

    def _together(self, lines: Iterable[LoggerLine]) -> Iterator[ProbeSample]:
        for line in lines:
            yield sample_of('', line, self._in_order)


class _Freshness:
    """Which lines are newer than those before, and of now."""

    def __init__(self, given: MqttParameters) -> None:
        self._given = given
        self._times: dict[str, float] = {}
        self._payloads: dict[str, bytes] = {}

    def doubt(self, message: MqttMessage, text: str, line: LoggerLine, now: float) -> str:
        """Return why a line is no new reading; empty if it is one."""
        topic = message.topic
        if not self._given.stamped or line.time == now:
            again = message.repeated and self._payloads.get(topic) == message.payload
            self._payloads[topic] = message.payload
            return f"'{text:.80}' was sent twice: left out" if again else ''
        last = self._times.get(topic, -inf)
        if line.time <= last:
            how = 'was sent twice' if line.time == last else 'is older than the line before it'
            return f"'{text:.80}' on '{topic}' {how}: left out"
        off = line.time - now
        if abs(off) > self._given.max_age and now >= EPOCHS[0]:
            return (
                f"the time of '{text:.80}' is {abs(off):.0f} s "
                f'{"ahead of" if off > 0.0 else "behind"} the clock here (mqtt.max_age '
                f'{self._given.max_age:g} s): left out; set the clock of the logger, or '
                'mqtt.utc_offset, or let a format without time stamp it on arrival'
            )
        self._times[topic] = line.time
        return ''
