"""The events of `bag_recorder`: triggers, `~/mark`, and a bag of each."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.qos import QoSProfile
from std_msgs.msg import String
from std_srvs.srv import Trigger as Ask

from agv_motion.bag.cdr import definitions
from agv_motion.bag.connection import Connection, Message
from agv_motion.bag.events.black_box import BlackBox
from agv_motion.bag.events.event import Moment
from agv_motion.bag.events.trigger import Trigger
from agv_motion.bag.notes import one_line
from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from agv_motion.bag.events.event import Event
    from agv_motion.bag.events.event_parameters import EventParameters
    from agv_motion.bag.recording.recording import Recording
    from agv_motion.ros.live_port import LivePort

MARKS = QoSProfile(depth=100)
MARKED = 'marked'
"""reason of a mark that tells none"""
PERIOD = 0.05
"""[s] between two looks at what was recorded; many messages are decoded at once"""


class RecordedEvents:
    """Watches what a recorder writes; each event becomes a bag while the recording goes on."""

    def __init__(self, port: LivePort, given: EventParameters, unable: Callable[[], str]) -> None:
        """Offer `~/mark`, as a service and as a topic that tells the reason.

        Args:
            port: Of the recorder.
            given: What is an event.
            unable: Returns why nothing is recorded at present, or ''.

        """
        self._port, self._given, self._unable = port, given, unable
        self._triggers = [
            Trigger(wanted._replace(name=self._absolute(wanted.name)))
            for wanted in given.conditions()
        ]
        self._box: BlackBox | None = None
        self._waiting: dict[int, list[Message]] = {}
        """messages of topics that triggers watch, by handle"""
        self._connections: dict[int, Connection] = {}
        port.every(PERIOD, self._update, steady=True)
        port.serve(Ask, '~/mark', lambda _: self._mark(''))
        port.listen(String, '~/mark', self._on_mark, MARKS)

    def wants(self, topic: str) -> bool:
        """Return whether a trigger may be about a topic, which is recorded then in any case."""
        return any(trigger.fits(topic) for trigger in self._triggers)

    def begin(self, recording: Recording) -> None:
        """Watch a new recording.

        Raises:
            SourceError: The disk takes nothing.

        """
        self._waiting.clear()
        self._connections.clear()
        self._box = BlackBox(recording, self._given, self._port.info, self._port.error)

    def meet(self, handle: int, topic: str, kind: str) -> None:
        """Let triggers watch a topic that is recorded from now on."""
        watching = [trigger for trigger in self._triggers if trigger.fits(topic)]
        if not watching:
            return
        text, known = definitions.installed(kind)
        connection = Connection(topic, kind, text, 'ros2msg', 'cdr', known, ())
        for trigger in watching:
            trigger.bind(connection)
            if trigger.problem:
                self._port.error(f'a trigger will not be met: {trigger.problem}')
        self._connections[handle] = connection
        self._waiting[handle] = []

    def see(self, handle: int, stamp: int, data: bytes) -> None:
        """Take a message that is recorded; it is looked at a little later."""
        waiting = self._waiting.get(handle)
        if waiting is not None:
            waiting.append(Message(self._connections[handle], stamp, data, stamp, 0))

    def finish(self) -> None:
        """End what goes on, before the recording is closed."""
        if self._box is not None:
            self._look(self._box)
            self._box.finish(self._port.nanoseconds())

    def close(self) -> None:
        """Wait for all bags, once the recording is closed."""
        if self._box is not None:
            self._box.close()

    def values(self) -> dict[str, str]:
        """Return what the diagnostics tell."""
        if self._box is None or not (self._triggers or self._box.saved or self._box.event):
            return {}
        blind = [str(trigger.wanted) for trigger in self._triggers if trigger.connection is None]
        values = {'events': str(len(self._box.saved)), 'events in': str(self._box.folder)}
        if self._box.event is not None:
            values['event now'] = self._box.event.first.reason
        if blind:
            values['triggers without a topic'] = ', '.join(blind)
        return values

    @property
    def saved(self) -> list[Path]:
        """Bags of events that were made since the recording began."""
        return self._box.saved if self._box else []

    def _update(self) -> None:
        if self._box is not None:
            self._look(self._box)
            self._box.update(self._port.nanoseconds())

    def _look(self, box: BlackBox) -> None:
        """Let the triggers see what came since the last time, in the order of time."""
        found: list[Moment] = []
        for handle, messages in self._waiting.items():
            if messages:
                for trigger in self._triggers:
                    if trigger.connection is self._connections[handle]:
                        found += trigger.moments(messages)
                messages.clear()
        for moment in sorted(found):
            self._add(box, moment)

    def _on_mark(self, message: String) -> None:
        self._mark(message.data)

    def _mark(self, reason: str) -> str:
        box, unable = self._box, self._unable()
        if box is None or unable:
            msg = unable or 'nothing is being recorded'
            raise ConfigurationError(msg)
        moment = Moment(self._port.nanoseconds(), one_line(reason) or MARKED)
        event = self._add(box, moment)
        return f"'{moment.reason}' is marked: {event.folder_name()} in {box.folder}"

    def _add(self, box: BlackBox, moment: Moment) -> Event:
        try:
            event = box.add(moment)
        except SourceError as error:
            self._port.error(f'an event would not survive a crash: {error}')
            assert box.event is not None
            return box.event
        if event.moments == (moment,):
            self._port.info(f"event '{moment.reason}': saved in {self._given.after:g} s")
        return event

    def _absolute(self, name: str) -> str:
        """Return the full name of a topic and what is in it."""
        return name if name.startswith('/') else self._port.full_name(name)
