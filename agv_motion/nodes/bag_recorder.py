"""Node `bag_recorder`: what the graph says, into a bag."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from rclpy.clock import Clock, ClockType
from std_srvs.srv import Trigger

from agv_motion.bag.recording import Recording, TopicReport
from agv_motion.bag.selection import Selection
from agv_motion.bag.storage import StorageParameters
from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.endpoints import message_class, offered
from agv_motion.ros.node import ManagedNode
from agv_motion.ros.run import run
from agv_motion.ros.tap import Tap, ears

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
    from rclpy.node import Node

    from agv_motion.bag.quality_of_service import OfferedQos

TAKE_PERIOD = 0.005
"""[s] between two takes; wide enough to take many at a time, and far below what queues hold"""


@dataclass(frozen=True)
class BagRecorderParameters:
    """What to record, and where to."""

    output: Annotated[
        str, Spec('folder of the new bag; empty: bag_ and the time, in the working directory')
    ] = ''
    all: Annotated[bool, Spec('record every topic')] = False
    topics: Annotated[tuple[str, ...], Spec('record these')] = ()
    regex: Annotated[str, Spec('record topics in whose name this is found')] = ''
    exclude_topics: Annotated[tuple[str, ...], Spec('never record these')] = ()
    exclude_regex: Annotated[str, Spec('never record topics in whose name this is found')] = ''
    include_hidden_topics: Annotated[bool, Spec('hidden topics as well')] = False
    start_paused: Annotated[bool, Spec('wait for ~/resume')] = False
    polling_interval: Annotated[float, Spec('between looks for new topics', 's', (0.01, 60))] = 0.1
    storage: StorageParameters = field(default_factory=StorageParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def folder(self) -> Path:
        """Return where the bag goes."""
        return Path(self.output or datetime.now().astimezone().strftime('bag_%Y_%m_%d-%H_%M_%S'))


class BagRecorder(ManagedNode[BagRecorderParameters]):
    """Records while active, from activation to deactivation one bag.

    Messages stay as they come, without being decoded.
    """

    def __init__(self, **kwargs: Any) -> None:
        """Declare the parameters."""
        super().__init__('bag_recorder', BagRecorderParameters, **kwargs)
        self.recording: Recording | None = None
        self.report: list[TopicReport] = []
        """of the last recording"""
        self.failure = ''
        """why the last recording ended by itself"""
        self.paused = False
        self._ears: Node | None = None

    def open(self) -> None:
        """Offer the services and look for topics."""
        given = self.parameters
        if not (given.all or given.topics or given.regex):
            msg = 'nothing to record: set all, topics or regex'
            raise ConfigurationError(msg)
        self._selection = Selection(
            everything=given.all,
            topics=tuple(self.resolve_topic_name(topic) for topic in given.topics),
            regex=given.regex,
            exclude_topics=tuple(self.resolve_topic_name(t) for t in given.exclude_topics),
            exclude_regex=given.exclude_regex,
            hidden=given.include_hidden_topics,
        )
        self._taps: dict[str, tuple[Tap, int]] = {}
        self._unusable: set[str] = set()
        self._simulated = bool(self.get_parameter('use_sim_time').value)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._ears = ears(self.get_name(), self.context)
        self.every(given.polling_interval, self._watch, steady)
        self.every(TAKE_PERIOD, self._take, steady)
        for name, act in (
            ('pause', self._pause),
            ('resume', self._resume),
            ('toggle_paused', self._toggle),
            ('split', self._split),
        ):
            self.serve(Trigger, f'~/{name}', act)

    @property
    def topics(self) -> int:
        """Number of topics that are being recorded."""
        return len(self._taps)

    def begin(self) -> None:
        """Create the bag."""
        self.report, self.failure = [], ''
        self.paused = self.parameters.start_paused
        self.recording = Recording(self.parameters.folder(), self.parameters.storage)
        self.get_logger().info(f'recording into {self.recording.path}')
        self._watch()

    def halt(self) -> None:
        """Finish the bag, and tell what was lost."""
        self._take()
        for tap, _ in self._taps.values():
            tap.close()
        self._taps.clear()
        if self.recording is None:
            return
        self.report = self.recording.close()
        self.failure = self.recording.failure
        missing = [topic for topic in self.report if topic.lost or topic.dropped]
        for topic in missing:
            self.get_logger().warning(
                f'{topic.name}: {topic.lost} lost on the way, {topic.dropped} dropped, '
                f'{topic.messages} recorded'
            )
        count = sum(topic.messages for topic in self.report)
        self.get_logger().info(f'{count} messages of {len(self.report)} topics recorded')
        self.recording = None

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Close the topics, and what they were heard with."""
        result = super().on_cleanup(state)
        if self._ears is not None:
            self._ears.destroy_node()
            self._ears = None
        return result

    def diagnose(self) -> Diagnosis:
        """Tell how much has been recorded."""
        if self.recording is None:
            return Diagnosis(ERROR, self.failure, {})
        values = {
            'bag': str(self.recording.path),
            'topics': str(self.topics),
            'messages': str(self.recording.messages),
        }
        return (
            Diagnosis(WARN, 'paused', values) if self.paused else Diagnosis(OK, 'recording', values)
        )

    def _watch(self) -> None:
        """Look for new topics and publishers, and whether the disk still takes everything."""
        if self.recording is None:
            return
        if self.recording.failure:
            self.get_logger().error(self.recording.failure)
            self.halt()
            return
        if self._simulated and not self._now().nanoseconds:
            return  # no time yet to stamp with
        for name, types in self.get_topic_names_and_types():
            if name not in self._unusable and self._selection.takes(name):
                self._meet(name, types, self.recording)

    def _take(self) -> None:
        for tap, _ in self._taps.values():
            tap.take()

    def _meet(self, name: str, types: Sequence[str], recording: Recording) -> None:
        """Record a topic that has publishers, and adapt to new ones."""
        publishers = self.get_publishers_info_by_topic(name)
        if not publishers:
            return
        if name not in self._taps:
            try:
                self._taps[name] = self._tap(name, types, offered(publishers), recording)
            except ConfigurationError as error:
                self._unusable.add(name)
                self.get_logger().error(f'{name} is not recorded: {error}')
                return
        tap, handle = self._taps[name]
        if tap.meet(publishers):
            recording.set_publishers(handle, tap.publishers)

    def _tap(
        self, name: str, types: Sequence[str], offers: Sequence[OfferedQos], recording: Recording
    ) -> tuple[Tap, int]:
        """Return what hears a topic, and its handle in the bag."""
        if len(types) > 1:
            msg = f'its publishers disagree on the type: {", ".join(types)}'
            raise ConfigurationError(msg)
        kind = message_class(types[0])
        handle = recording.add_topic(name, types[0], offers)
        put, now = recording.put, self._now

        def take(data: bytes, info: dict[str, Any]) -> None:
            if not self.paused:
                sent, received = info['source_timestamp'], info['received_timestamp']
                put(handle, received, data, sent, info['publication_sequence_number'] or 0)

        def take_simulated(data: bytes, info: dict[str, Any]) -> None:
            if not self.paused:
                stamp = now().nanoseconds
                put(handle, stamp, data, stamp, info['publication_sequence_number'] or 0)

        assert self._ears is not None
        return Tap(self._ears, name, kind, take_simulated if self._simulated else take), handle

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
            msg = 'nothing is being recorded'
            raise ConfigurationError(msg)
        self.recording.split()
        return f'going on in a new file of {self.recording.path}'


def main() -> None:
    """Run the node."""
    run(BagRecorder)


if __name__ == '__main__':
    main()
