"""Which broker, which topics, and who asks: never a password, but where it is kept."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec
from agv_motion.probe.sources.line_reading import LineParameters

_TOPIC = re.compile(r'(?:(?:\+|[^+#\0/]*)/)*(?:[+#]|[^+#\0/]*)')
LONGEST_TOPIC = 65535
"""[bytes] of the protocol"""


@dataclass(frozen=True)
class MqttParameters(LineParameters):
    """The broker, and what stands in each message."""

    host: Annotated[str, Spec('name or address of the broker')] = 'localhost'
    port: Annotated[int, Spec('of the broker; 8883 is usual with tls', '1', (1, 65535))] = 1883
    topics: Annotated[
        tuple[str, ...],
        Spec(
            'one whose messages tell all probes (+ and # stand for any level, of one logger), or '
            'one for each probe: then fields tells which value of its own message each probe is'
        ),
    ] = ('granier/probes',)
    qos: Annotated[int, Spec('of the subscription: at most, at least, just once', '1', (0, 2))] = 1
    client_id: Annotated[
        str, Spec('by which the broker knows this node, its own among all; empty: a new one')
    ] = ''
    user: Annotated[str, Spec('at the broker; empty: none')] = ''
    password_env: Annotated[
        str, Spec('environment variable that holds the password; empty: none does')
    ] = ''
    password_file: Annotated[str, Spec('file that holds the password; empty: none does')] = ''
    tls: Annotated[bool, Spec('encrypt, and ask the broker for a certificate of its host')] = False
    tls_ca_file: Annotated[
        str, Spec('authorities that vouch for the broker, as PEM; empty: those of the system')
    ] = ''
    keep_alive: Annotated[
        int, Spec('after which a broker that says nothing is asked, and left', 's', (2, 3600))
    ] = 30
    max_age: Annotated[
        float,
        Spec(
            'a line whose time is further from the clock here when it arrives is no new reading',
            's',
            (1.0, 1e6),
        ),
    ] = 600.0

    def __post_init__(self) -> None:
        """Check every row, and what they say together.

        Raises:
            ConfigurationError: A value or their combination cannot be.

        """
        super().__post_init__()
        self._check_topics()
        if not self.host or any(letter.isspace() or letter in '\0/' for letter in self.host):
            msg = f"host = '{self.host}': give a name or address alone, such as broker.local"
            raise ConfigurationError(msg)
        if self.password_env and self.password_file:
            msg = 'password_env and password_file: give one of them'
            raise ConfigurationError(msg)
        if (self.password_env or self.password_file) and not self.user:
            msg = 'a password without a user: give user too'
            raise ConfigurationError(msg)
        if self.tls_ca_file and not self.tls:
            msg = f"tls_ca_file = '{self.tls_ca_file}' without tls: set tls to true"
            raise ConfigurationError(msg)

    def _check_topics(self) -> None:
        topics = self.topics
        for topic in topics:
            long = len(topic.encode('utf-8', 'surrogatepass')) > LONGEST_TOPIC
            if not topic or long or not _TOPIC.fullmatch(topic):
                msg = (
                    f"topics = '{topic:.80}': give one such as granier/probes; + stands for one "
                    'whole level, # for the last ones'
                )
                raise ConfigurationError(msg)
        if len(topics) == 1:
            return
        if len(topics) != len(self.fields) or len(set(topics)) < len(topics):
            msg = f'topics = {list(topics)}: give one for all probes, or one for each of fields'
            raise ConfigurationError(msg)
        if any('+' in topic or '#' in topic for topic in topics):
            msg = f'topics = {list(topics)}: a topic of one probe has no + or #, it is one alone'
            raise ConfigurationError(msg)
        if self.radiation_field or self.vpd_field:
            msg = 'radiation_field, vpd_field: they need one topic that tells all'
            raise ConfigurationError(msg)

    @property
    def broker(self) -> str:
        """Host and port, for people."""
        return f'{self.host}:{self.port}'

    def password(self) -> str | None:
        """Return the password, as it is now; None where there is none.

        Raises:
            ConfigurationError: It is not where it should be. The message never holds it.

        """
        if self.password_env:
            word = os.environ.get(self.password_env, '')
            where = f'password_env = {self.password_env}: no such environment variable, or empty'
        elif self.password_file:
            where = f'password_file = {self.password_file}: it is empty'
            try:
                word = Path(self.password_file).read_text('utf-8').rstrip('\r\n')
            except (OSError, ValueError) as error:
                reason = error.strerror if isinstance(error, OSError) else 'no text of UTF-8'
                msg = f'password_file = {self.password_file} cannot be read: {reason}'
                raise ConfigurationError(msg) from None
        else:
            return None
        if not word:
            raise ConfigurationError(where)
        return word
