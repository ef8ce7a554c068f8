"""Node `bag_player`: what a bag holds, to the graph, each message at its time."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from rclpy.duration import Duration
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock as ClockMessage
from std_srvs.srv import Trigger

from agv_motion.bag.playback.excerpt import PlaybackExcerpt
from agv_motion.bag.playback.playback import Playback
from agv_motion.bag.playback.playback_parameters import PlaybackParameters
from agv_motion.bag.playback.several_bags import SeveralBags
from agv_motion.bag.quality_of_service import KEYS, NO_PROFILE, WORDS, OfferedQos
from agv_motion.errors import ConfigurationError
from agv_motion.files import yaml_text
from agv_motion.files.marked import quoted
from agv_motion.parameters import Spec
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.endpoints import message_class, offering
from agv_motion.ros.messages import stamp_of
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.run import run
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.bag.connection import Connection, Message
    from agv_motion.files.marked import Marked
    from agv_motion.ros.live_port import LivePort


DEEPEST = 1_000_000
"""Messages that a publisher may keep for late listeners."""

CLOCK = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


@dataclass(frozen=True)
class BagPlayerParameters(PlaybackParameters):
    """Which bag to play, how, and what else to tell."""

    bag: Annotated[str, Spec('folder or file of the bag')] = ''
    bags: Annotated[tuple[str, ...], Spec('more of them, played with it by one clock')] = ()
    clock: Annotated[
        float, Spec('rate at which /clock tells the time of the bag; 0: not', 'Hz', (0.0, 1000.0))
    ] = 0.0
    qos_overrides: Annotated[
        str, Spec('YAML file with quality of service by topic, as ros2 bag play takes it')
    ] = ''
    wait_for_all_acked: Annotated[
        float,
        Spec(
            'how long to wait at the end until all listeners confirm; negative: not',
            's',
            (-1, 1e6),
        ),
    ] = -1.0
    seek_to: Annotated[
        float, Spec('where ~/seek goes, from the start of the bag', 's', (0.0, 1e10), dynamic=True)
    ] = 0.0
    burst: Annotated[
        int, Spec('how many messages ~/burst sends', '', (1, 1_000_000), dynamic=True)
    ] = 100


class BagPlayer(PlainNode[BagPlayerParameters]):
    """Plays while active; messages go out as they stand in the bag, without being decoded."""

    name = 'bag_player'
    takes = BagPlayerParameters

    port: LivePort

    def __init__(self, port: LivePort, parameters: BagPlayerParameters) -> None:
        """Open the bag, a publisher for each topic, and the services."""
        super().__init__(port, parameters)
        self.playback: Playback | None = None
        self.unplayed: dict[str, str] = {}
        """topics that cannot be played, and why"""
        given = parameters
        paths = [path for path in (given.bag, *given.bags) if path]
        if not paths:
            msg = 'which bag? give bag, the path of a folder or file'
            raise ConfigurationError(msg)
        self._bag = SeveralBags(paths)
        port.close_later(self._bag.close)
        for problem in self._bag.problems:
            port.warning(str(problem))
        self._offers = _overrides(given.qos_overrides)
        topics = PlaybackExcerpt(self._bag, given).topics
        for topic in self._offers:
            if topic not in topics:
                port.warning(
                    f"qos_overrides: no topic '{topic:.200}' is played{meant(topic, topics)}"
                )
        self._publish = self._open_topics(topics)
        if given.clock:
            self._clock_message = ClockMessage()
            self._clock_publisher = port.publisher(ClockMessage, '/clock', CLOCK)
            port.every(1.0 / given.clock, self._tell_time, steady=True)
        for name, act in (
            ('pause', self._pause),
            ('resume', self._resume),
            ('toggle_paused', self._toggle),
            ('play_next', lambda _: self._play(1)),
            ('burst', lambda _: self._play(self.parameters.burst)),
            ('seek', self._seek),
        ):
            port.serve(Trigger, f'~/{name}', act)

    @property
    def lossy(self) -> bool:
        """Whether the bag has lost something."""
        return self._bag.lossy

    def begin(self) -> None:
        """Begin to play."""
        self.playback = Playback(self._bag, self.parameters, self._send, self._offers)
        excerpt = self.playback.excerpt
        excerpt.topics = [t for t in excerpt.topics if t in self._publish]
        self.playback.start()

    def halt(self) -> None:
        """Stop, and tell how late the messages were."""
        self.playing.stop()
        if self.playing.failure:
            self.port.error(self.playing.failure)
        limit = self.parameters.wait_for_all_acked
        if limit >= 0.0 and not self._acknowledged(limit):
            self.port.warning(f'not every listener has confirmed within {limit:g} s')
        self.port.info(str(self.playing.lag))

    def accept(self, parameters: BagPlayerParameters) -> None:
        """Take over another rate."""
        if self.playback is not None and parameters.rate != self.parameters.rate:
            self.playback.set_rate(parameters.rate)

    def diagnose(self) -> Diagnosis:
        """Tell where it stands."""
        playing = self.playing
        values = {'position [s]': f'{(playing.position() - self._bag.start) * 1e-9:.3f}'}
        if playing.failure:
            return Diagnosis(ERROR, playing.failure, values)
        if playing.finished.is_set():
            return Diagnosis(OK, 'finished', values)
        return Diagnosis(*((WARN, 'paused') if playing.paused else (OK, 'playing')), values)

    @property
    def playing(self) -> Playback:
        """The playback; there is one from the first activation on."""
        assert self.playback is not None
        return self.playback

    def _open_topics(self, topics: Sequence[str]) -> dict[str, Any]:
        """Return the function that publishes each topic, by name."""
        publish, overrides = {}, self._offers
        for topic in topics:
            connection = self._bag.topics[topic]
            if topic == '/clock' and self.parameters.clock:
                continue  # one clock is enough
            try:
                kind = _played(connection)
            except ConfigurationError as error:
                self.unplayed[topic] = str(error)
                self.port.error(f'{topic} is not played: {error}')
                continue
            qos = offering([overrides[topic]] if topic in overrides else connection.qos)
            publish[topic] = self.port.publisher(kind, topic, qos).publish
        for other in self._bag.connections:
            if other.topic in publish and other.type != self._bag.topics[other.topic].type:
                self.port.error(
                    f'{other.topic} is a {self._bag.topics[other.topic].type} first: its messages '
                    f'of type {other.type} are not played'
                )
        return publish

    def _send(self, message: Message) -> None:
        topic, kind = message.connection.topic, message.connection.type
        publish = self._publish.get(topic)
        if publish is not None and kind == self._bag.topics[topic].type:
            publish(message.data)

    def _tell_time(self) -> None:
        self._clock_message.clock = stamp_of(self.playing.position())
        self._clock_publisher.publish(self._clock_message)

    def _acknowledged(self, limit: float) -> bool:
        patience = Duration(seconds=limit)
        return all(
            publisher.wait_for_all_acked(patience) for publisher in self.port.node.publishers
        )

    def _pause(self, _: Any = None) -> str:
        self.playing.pause()
        return 'paused'

    def _resume(self, _: Any = None) -> str:
        if self.playing.finished.is_set():
            msg = 'at the end: there is nothing to play; seek first'
            raise ConfigurationError(msg)
        self.playing.resume()
        return 'playing'

    def _toggle(self, _: Any) -> str:
        return self._resume() if self.playing.paused else self._pause()

    def _play(self, count: int) -> str:
        self.playing.play_next(count)
        return f'sending {count}'

    def _seek(self, _: Any) -> str:
        self.playing.seek(self._bag.start + round(self.parameters.seek_to * 1e9))
        return f'at {self.parameters.seek_to:g} s'


def _played(connection: Connection) -> Any:
    """Return the class of the messages of a topic.

    Raises:
        ConfigurationError: It is not installed, or they are none of ROS.

    """
    if connection.encoding != 'cdr':
        msg = f'its messages are encoded in {connection.encoding!r}, which is not of ROS'
        raise ConfigurationError(msg)
    return message_class(connection.type)


def _overrides(path: str) -> dict[str, OfferedQos]:
    """Return the quality of service of each topic in a file.

    Raises:
        ConfigurationError: The file cannot be read, or a topic has no profile.

    """
    if not path:
        return {}
    topics = yaml_text.load(Path(path), 'qos_overrides').mapping('qos_overrides')
    return {topic: _profile(topic, entries) for topic, (_, entries) in topics.items()}


def _profile(topic: str, entries: Marked) -> OfferedQos:
    """Return what is given for a topic; a word that ROS does not know is for nobody to guess."""
    expected = 'expected reliability, durability, history, depth'
    for key, (where, value) in entries.mapping(f'{topic:.80}').items():
        choices = WORDS.get(key)
        if key not in KEYS:
            where.refuse(
                f'{topic:.80}: there is no {key:.80}{meant(key, KEYS)}; {expected}', expected
            )
        if choices and value.value not in choices:
            told = f'{key}: choose one of {", ".join(choices)}'
            value.refuse(f'{topic:.80}: {quoted(value.value)}: {told}', told)
        if key == 'depth' and not 0 <= value.typed('depth', int) < DEEPEST:
            value.refuse(f'{topic:.80}: depth must lie in [0, {DEEPEST})', expected)
    try:
        return OfferedQos.from_entries(entries.value)
    except NO_PROFILE as error:
        entries.refuse(f'{topic:.80}: {error!r:.80}; {expected}', expected)


def main() -> None:
    """Run the node."""
    run(BagPlayer)


if __name__ == '__main__':
    main()
