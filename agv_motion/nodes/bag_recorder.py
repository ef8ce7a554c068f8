"""Node `bag_recorder`: what the graph says, into a bag."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING, Any

from rosgraph_msgs.msg import Clock as ClockMessage
from std_srvs.srv import Trigger

from agv_motion.bag.recording.recorded_transforms import RecordedTransforms
from agv_motion.bag.recording.recording import Recording, TopicReport
from agv_motion.bag.selection import Selection
from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.model.transform_message import TF, TF_STATIC, TYPE
from agv_motion.nodes.bag_recorder_parameters import BagRecorderParameters
from agv_motion.nodes.recorded_events import RecordedEvents
from agv_motion.ros.arrivals import TICK, Arrivals
from agv_motion.ros.clock_guard import CLOCK_TOPIC
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.endpoints import message_class, offered
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.raw_subscription import ListenerNodes, RawSubscription
from agv_motion.ros.run import run

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.bag.quality_of_service import OfferedQos
    from agv_motion.ros.live_port import LivePort


TAKE_PERIOD = 0.005
"""[s] between two takes; wide enough to take many at a time, and far below what queues hold"""


class BagRecorder(PlainNode[BagRecorderParameters]):
    """Records while active, from activation to deactivation one bag.

    Messages stay as they come, without being decoded.
    """

    name = 'bag_recorder'
    takes = BagRecorderParameters

    port: LivePort

    def __init__(self, port: LivePort, parameters: BagRecorderParameters) -> None:
        """Offer the services and look for topics."""
        super().__init__(port, parameters)
        self.recording: Recording | None = None
        self.report: list[TopicReport] = []
        """of the last recording"""
        self.failure = ''
        """why the last recording ended by itself"""
        self.paused = False
        given = parameters
        if not (given.all or given.topics or given.regex):
            msg = 'nothing to record: set all, topics or regex'
            raise ConfigurationError(msg)
        self._selection = Selection(
            everything=given.all,
            topics=tuple(port.full_name(topic) for topic in given.topics),
            regex=given.regex,
            exclude_topics=tuple(port.full_name(t) for t in given.exclude_topics),
            exclude_regex=given.exclude_regex,
            hidden=given.include_hidden_topics,
        )
        self._subscriptions: dict[tuple[str, str], tuple[RawSubscription, int]] = {}
        """by name and type of the topic, each with its handle in the bag"""
        self._unusable: set[tuple[str, str]] = set()
        self._arrivals: Arrivals | None = None
        """where time is simulated"""
        self._transforms: RecordedTransforms | None = None
        """that nobody publishes; None while nothing is recorded"""
        self._listeners = ListenerNodes(port.name, port.node.context)
        port.close_later(self._listeners.close)
        port.every(given.polling_interval, self._watch, steady=True)
        port.every(TAKE_PERIOD, self._take, steady=True)
        self.events = RecordedEvents(port, given, self._unable)
        for name, act in (
            ('pause', self._pause),
            ('resume', self._resume),
            ('toggle_paused', self._toggle),
            ('split', self._split),
        ):
            port.serve(Trigger, f'~/{name}', act)

    @property
    def topics(self) -> int:
        """Number of topics that are being recorded."""
        return len({name for name, _ in self._subscriptions if name})

    def begin(self) -> None:
        """Create the bag."""
        self.report, self.failure = [], ''
        self.paused = self.parameters.start_paused
        self.recording = Recording(self.parameters.folder(), self.parameters.ring())
        self._transforms = RecordedTransforms(self.recording.add_topic)
        for topic in (TF, TF_STATIC):
            if not self._selection.takes(topic):
                self._transforms.leave(topic)
        self.port.info(f'recording into {self.recording.path}')
        self.events.begin(self.recording)
        self._watch()

    def halt(self) -> None:
        """Finish the bag, and tell what was lost."""
        self._take()
        now = self.port.nanoseconds()
        if self._arrivals is not None:
            self._arrivals.pass_on()
            now, self._arrivals = self._arrivals.now, None
        if self._transforms is not None and self.recording is not None:
            for handle, told in self._transforms.last():
                self.recording.put(handle, now, told, now)
        for subscription, _ in self._subscriptions.values():
            subscription.close()
        self._subscriptions.clear()
        if self.recording is None:
            return
        self.events.finish()
        self.report = self.recording.close()
        self.events.close()
        self.failure = self.recording.failure
        missing = [topic for topic in self.report if topic.lost or topic.dropped]
        for topic in missing:
            self.port.warning(
                f'{topic.name}: {topic.lost} lost on the way, {topic.dropped} dropped, '
                f'{topic.messages} recorded'
            )
        count, deleted = (
            sum(getattr(topic, what) for topic in self.report) for what in ('messages', 'deleted')
        )
        gone = f', {deleted} deleted with the oldest files' if deleted else ''
        self.port.info(f'{count} messages of {len(self.report)} topics recorded{gone}')
        self.recording = None

    def diagnose(self) -> Diagnosis:
        """Tell how much has been recorded."""
        if self.recording is None:
            return Diagnosis(ERROR, self.failure, {})
        values = {
            'bag': str(self.recording.path),
            'topics': str(self.topics),
            'messages': str(self.recording.messages),
            **self.events.values(),
        }
        return (
            Diagnosis(WARN, 'paused', values) if self.paused else Diagnosis(OK, 'recording', values)
        )

    def _watch(self) -> None:
        """Look for new topics and publishers, and whether the disk still takes everything."""
        if self.recording is None:
            return
        if self.recording.failure:
            self.port.error(self.recording.failure)
            self.halt()
            return
        if self.port.is_simulated and not self.port.nanoseconds():
            return  # no time yet to stamp with
        if self.port.is_simulated:
            self._listen_to_clock()
        for name, types in self.port.node.get_topic_names_and_types():
            if self._selection.takes(name) or self.events.wants(name):
                for kind in types:
                    self._meet(name, kind, self.recording)

    def _listen_to_clock(self) -> None:
        """Hear `/clock` among the messages that it stamps."""
        if self._arrivals is None:
            self._arrivals = Arrivals(self._put, self.port.nanoseconds())
            add, node = partial(self._arrivals.add, TICK), self._listeners.node(0)
            self._subscriptions['', ''] = (
                RawSubscription(node, CLOCK_TOPIC, ClockMessage, add),
                TICK,
            )
        self._subscriptions['', ''][0].meet(
            self.port.node.get_publishers_info_by_topic(CLOCK_TOPIC)
        )

    def _take(self) -> None:
        begun = time.time_ns()
        for subscription, _ in self._subscriptions.values():
            subscription.take()
        if self._arrivals is not None:
            self._arrivals.pass_on(begun)

    def _meet(self, name: str, kind: str, recording: Recording) -> None:
        """Record a topic that has publishers of a type, and adapt to new ones."""
        publishers = [
            one
            for one in self.port.node.get_publishers_info_by_topic(name)
            if one.topic_type == kind
        ]
        if not publishers or (name, kind) in self._unusable:
            return
        if (name, kind) not in self._subscriptions:
            try:
                self._subscriptions[name, kind] = self._subscribe(
                    name, kind, offered(publishers), recording
                )
            except (ConfigurationError, SourceError) as error:
                self._unusable.add((name, kind))
                self.port.error(f'{name} is not recorded: {error}')
                return
        subscription, handle = self._subscriptions[name, kind]
        if subscription.meet(publishers):
            recording.set_publishers(handle, subscription.publishers)

    def _subscribe(
        self, name: str, kind: str, offers: Sequence[OfferedQos], recording: Recording
    ) -> tuple[RawSubscription, int]:
        """Return what hears a topic, and its handle in the bag."""
        others = [other for topic, other in self._subscriptions if topic == name]
        if others:
            self.port.warning(
                f'{name} is published as {kind} too, beside {", ".join(others)}: all are recorded; '
                'what reads the bag may expect one type: give each a topic of its own'
            )
        message = message_class(kind)
        made = self._transforms.leave(name) if self._transforms and kind == TYPE else None
        handle = recording.add_topic(name, kind, offers) if made is None else made
        self.events.meet(handle, name, kind)
        put, arrivals, transforms = self._put, self._arrivals, self._transforms
        moves = transforms if transforms and transforms.wants(name, kind) else None

        def take(data: bytes, info: dict[str, Any]) -> None:
            if not self.paused:
                sent, received = info['source_timestamp'], info['received_timestamp']
                put(handle, received, data, sent, info['publication_sequence_number'] or 0)
                for other, told in moves.take(name, data) if moves else ():
                    put(other, received, told, sent)

        def take_simulated(data: bytes, info: dict[str, Any]) -> None:
            if not self.paused and arrivals is not None:
                arrivals.add(handle, data, info)
                for other, told in moves.take(name, data) if moves else ():
                    arrivals.add(other, told, info | {'publication_sequence_number': 0})

        node = self._listeners.node(len(others))
        return RawSubscription(
            node, name, message, take_simulated if self.port.is_simulated else take
        ), handle

    def _put(self, topic: int, received: int, data: bytes, sent: int, sequence: int = 0) -> None:
        """Record a message, and show it to the triggers."""
        if self.recording is not None:
            self.recording.put(topic, received, data, sent, sequence)
            self.events.see(topic, received, data)

    def _unable(self) -> str:
        """Return why nothing is recorded at present, or ''."""
        if self.recording is None or self.recording.failure:
            return 'nothing is being recorded'
        return 'paused: nothing is recorded; resume first' if self.paused else ''

    def _pause(self, _: Any = None) -> str:
        self.paused = True
        return 'paused: nothing is recorded'

    def _resume(self, _: Any = None) -> str:
        if self.paused and self.recording is not None:
            self.recording.interrupt()
        self.paused = False
        return 'recording'

    def _toggle(self, _: Any) -> str:
        return self._resume() if self.paused else self._pause()

    def _split(self, _: Any) -> str:
        if self.recording is None or self.recording.failure:
            raise ConfigurationError(self._unable())
        self.recording.split()
        return f'going on in a new file of {self.recording.path}'


def main() -> None:
    """Run the node."""
    run(BagRecorder)


if __name__ == '__main__':
    main()
