"""A subscription at an MQTT broker, kept up by a thread of its own: messages and troubles out."""

from __future__ import annotations

from collections import deque
from threading import Event, Thread
from time import monotonic
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.errors import ConfigurationError
from agv_motion.probe.sources.attempts import LONGEST_PAUSE, Attempts

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.probe.sources.mqtt_parameters import MqttParameters

TICK = 0.2
"""[s] within which the thread sees that it is to end"""
CONNECT_LIMIT = 4.0
"""[s] for the broker to answer, and again for its certificate"""
MOST_WAITING = 10_000
"""Messages that wait to be read; those beyond are dropped, and told."""
LONGEST_PAYLOAD = 65536
"""[bytes] No reading is longer."""


class MqttMessage(NamedTuple):
    """One message of a topic."""

    topic: str
    payload: bytes
    retained: bool
    """kept by the broker from before the subscription: of any age"""
    repeated: bool
    """sent once more, since nobody said that it had come"""
    at: float
    """[s] of the steady clock, when it came"""


class MqttConnection:
    """Connects, subscribes, and begins anew after pauses that grow."""

    def __init__(self, parameters: MqttParameters) -> None:
        """Check that it can be tried; `start` begins.

        Raises:
            ConfigurationError: paho-mqtt is missing, or password or authorities cannot be read.

        """
        self._given = parameters
        self._messages: deque[MqttMessage] = deque()
        self._troubles: deque[str] = deque(maxlen=20)
        self._closing = Event()
        self._subscribed = Event()
        self._thread: Thread | None = None
        self._refusal = ''
        self._client()

    @property
    def subscribed(self) -> bool:
        """Whether the broker sends what comes."""
        return self._subscribed.is_set()

    def start(self) -> None:
        """Begin, unless it has begun or was closed."""
        if self._thread is None and not self._closing.is_set():
            self._thread = Thread(target=self._run, name='mqtt probes', daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Leave the broker and end the thread; waits for no broker longer than its limits."""
        self._closing.set()
        if self._thread is not None:
            self._thread.join(2.0 * CONNECT_LIMIT + 2.0 * TICK)

    def messages(self) -> Iterator[MqttMessage]:
        """Yield what has come since the last call."""
        while self._messages:
            yield self._messages.popleft()

    def troubles(self) -> Iterator[str]:
        """Yield what went wrong, and that it is well again, since the last call."""
        while self._troubles:
            yield self._troubles.popleft()

    def _run(self) -> None:
        attempts, broker, lost = Attempts(), self._given.broker, False
        while not self._closing.is_set():
            began = monotonic()
            try:
                trouble = self._session(lost=lost)
            except Exception as error:  # noqa: BLE001 - whatever it is, it is told and tried again
                trouble = f'cannot be used ({error or type(error).__name__})'
            self._subscribed.clear()
            if self._closing.is_set():
                return
            lost = True
            if monotonic() - began > LONGEST_PAUSE:  # one that lasted
                attempts = Attempts()
            pause = attempts.fail()
            self._troubles.append(f'{broker} {trouble}; trying again in {pause:.0f} s')
            self._closing.wait(pause)

    def _session(self, *, lost: bool) -> str:
        """Stay connected for as long as it lasts, and return why it ended."""
        given, self._refusal = self._given, ''
        client = self._client()
        try:
            client.connect(given.host, given.port, given.keep_alive)
        except OSError as error:
            look = 'mqtt.tls, tls_ca_file and the name in its certificate' if given.tls else ''
            return f'is not reachable ({error}): check {look or "mqtt.host, port and the network"}'
        try:
            while not self._closing.is_set():
                if result := client.loop(TICK):
                    return self._refusal or f'has gone ({_reason(result)})'
                if lost and self.subscribed:
                    self._troubles.append(f'{given.broker} is there again')
                    lost = False
        finally:
            client.disconnect()
        return ''

    def _client(self) -> Any:
        """Return a client that knows who it is and whom to trust.

        Raises:
            ConfigurationError: paho-mqtt is missing, or password or authorities cannot be read.

        """
        try:
            from paho.mqtt import client as paho  # noqa: PLC0415 - an extra
        except ImportError as error:
            msg = 'source = mqtt needs paho-mqtt: pip install "agv_motion[mqtt]"'
            raise ConfigurationError(msg) from error
        given = self._given
        client = paho.Client(paho.CallbackAPIVersion.VERSION2, given.client_id or None)
        client.connect_timeout = CONNECT_LIMIT
        if given.user:
            client.username_pw_set(given.user, given.password())
        if given.tls:
            try:
                client.tls_set(ca_certs=given.tls_ca_file or None)
            except (OSError, ValueError) as error:
                msg = f"tls_ca_file = '{given.tls_ca_file}' cannot be used: {error}"
                raise ConfigurationError(msg) from error
        client.on_connect, client.on_subscribe = self._on_connect, self._on_subscribe
        client.on_message = self._on_message
        return client

    def _on_connect(self, client: Any, _: Any, __: Any, reason: Any, ___: Any) -> None:
        if reason.is_failure:
            self._refusal = (
                f'refuses this client ({reason}): check mqtt.user, its password and client_id'
            )
        else:
            client.subscribe([(topic, self._given.qos) for topic in self._given.topics])

    def _on_subscribe(self, _: Any, __: Any, ___: Any, reasons: Any, ____: Any) -> None:
        refused = [
            topic
            for topic, reason in zip(self._given.topics, reasons, strict=False)
            if reason.is_failure
        ]
        if refused:
            self._troubles.append(
                f'{self._given.broker} refuses the topics {refused}: check what the user may read'
            )
        if len(refused) < len(reasons):
            self._subscribed.set()

    def _on_message(self, _: Any, __: Any, message: Any) -> None:
        size = len(message.payload)
        if size > LONGEST_PAYLOAD:
            self._troubles.append(f"a message of {size} bytes on '{message.topic}' was dropped")
        elif len(self._messages) >= MOST_WAITING:
            self._troubles.append(f'more than {MOST_WAITING} messages wait: new ones are dropped')
        else:
            self._messages.append(
                MqttMessage(
                    message.topic, message.payload, message.retain, message.dup, monotonic()
                )
            )


def _reason(result: int) -> str:
    from paho.mqtt.client import error_string  # noqa: PLC0415 - an extra

    return str(error_string(result)).rstrip('.')
