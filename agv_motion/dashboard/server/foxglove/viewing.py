"""One client that looks at a bag: it plays it by its own controls, or by parameters."""

from __future__ import annotations

import asyncio
import threading
import time
from dataclasses import dataclass, field
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any, Protocol

from agv_motion.dashboard.foxglove import protocol
from agv_motion.dashboard.foxglove import requests as asked
from agv_motion.dashboard.foxglove.channels import Channels
from agv_motion.dashboard.foxglove.frames import frame
from agv_motion.dashboard.foxglove.playback import SECOND, BagViewing, require_rate
from agv_motion.dashboard.foxglove.protocol import Capability, PlaybackStatus, Severity
from agv_motion.dashboard.foxglove.requests import ProtocolError
from agv_motion.dashboard.foxglove.transforms import DerivedTransforms

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from agv_motion.bag.reader import BagReader
    from agv_motion.dashboard.server.foxglove.client import FoxgloveClient
    from agv_motion.dashboard.server.foxglove.recorded_topics import RecordedTopics

PERIOD = 0.01
"""[s] between two looks for what is due"""
MOST_ASKED = 2000
"""requests that may wait for the next look, which a client puts off by taking nothing"""
TIME_PERIOD = 0.1
"""[s] after which the time is told again though nothing is due"""
PLAYING, RATE, PLACE = '/playback.playing', '/playback.rate', '/playback.seconds'
"""Parameters: whether it plays, how fast, and the time since the beginning of the bag [s]"""
RECORDED = 'this is a recording: it can be played, and nothing else'


class ServedBag(Protocol):
    """A bag that is served."""

    path: Path
    rate: float
    session: str
    contents: RecordedTopics

    def open(self) -> BagReader:
        """Return the bag, opened anew."""


@dataclass
class _Asked:
    """What a client has asked for since the last look; of a kind only the last counts."""

    chosen: frozenset[str] | None = None
    """topics"""
    seek: int | None = None
    """[ns]"""
    rate: float | None = None
    playing: bool = False
    """counts where a rate is told"""
    answers: list[Callable[[], Any]] = field(default_factory=list)


class Viewing:
    """One client that looks at the bag."""

    def __init__(self, room: ServedBag, client: FoxgloveClient, *, controls: bool) -> None:
        """Open the bag.

        Args:
            room: The bag.
            client: Who looks.
            controls: Whether it has controls of its own for a playback.

        Raises:
            AgvMotionError: The bag is gone meanwhile.

        """
        self._room, self._client, self._controls = room, client, controls
        self._player = BagViewing(room.open(), room.rate)
        self._channels = Channels()
        self._channels.update(room.contents.topics)
        self._asked = _Asked()
        """what is done to the player between two looks, by nobody else"""
        self._acts: dict[type[Any], Callable[[Any], None]] = {
            asked.Subscribe: self._subscribe,
            asked.Unsubscribe: self._unsubscribe,
            asked.Control: self._control,
            asked.GetParameters: self._get,
            asked.SetParameters: self._set,
            asked.WatchParameters: lambda told: setattr(self, '_watched', told.on),
            asked.FetchAsset: lambda told: client.send(protocol.asset_refusal(told.id, RECORDED)),
        }
        self._watched = False
        self._lock = threading.Lock()
        self._transforms = DerivedTransforms(inf)
        self._offered = self._transforms.offered(
            {
                name: one
                for name, one in room.contents.topics.items()
                if name in room.contents.recorded
            }
        )
        self._chosen: frozenset[str] = frozenset()

    def begin(self) -> None:
        """Tell what is in the bag, and play it."""
        client, room = self._client, self._room
        capabilities = [Capability.TIME, Capability.PARAMETERS, Capability.WATCH_PARAMETERS]
        if self._controls:
            capabilities.append(Capability.PLAYBACK)
        span = room.contents.span if self._controls else None
        told = {'bag': room.path.name}
        client.send(
            protocol.server_info(room.path.name, capabilities, room.session, span, told)
        )  # fmt: skip
        client.send(protocol.advertise(c.info for c in self._channels.by_number.values()))
        for topic, why in room.contents.complaints.items():
            client.tell(Severity.WARNING, f'{topic} is not served: {why}', topic)
        self._player.play(time.monotonic())
        self._tell_state('')
        client.begin(self._run())

    def end(self) -> None:
        """Play no more, and let go of the bag."""
        self._client.close()
        asyncio.get_running_loop().run_in_executor(None, self._close)

    def _close(self) -> None:
        with self._lock:  # a look may be under way
            self._player.close()

    def do(self, request: Any) -> None:
        """Do what the client asks.

        Raises:
            ProtocolError: It cannot be done.

        """
        act = self._acts.get(type(request))
        if act is None:
            raise ProtocolError(RECORDED)
        if len(self._asked.answers) >= MOST_ASKED:
            msg = f'{MOST_ASKED} requests wait until you have taken what you were sent'
            raise ProtocolError(msg)
        act(request)

    async def _run(self) -> None:
        """Send what is due, again and again; reading happens beside the server."""
        told_at, was = 0.0, PlaybackStatus.PAUSED
        while self._client.wire.is_open:
            now = time.monotonic()
            if self._client.wire.waiting:
                self._player.hold(now)
            else:
                asked_for, self._asked = self._asked, _Asked()
                due = await asyncio.to_thread(self._looked, asked_for, now)
                fresh = self._channels.take(due)
                moved = bool(due) or now - told_at >= TIME_PERIOD
                place = frame(protocol.time_data(self._player.position(now))) if moved else None
                told_at = now if moved else told_at
                self._client.serve(fresh, self._channels.count, place)
            status = self._player.status(now)
            if status is PlaybackStatus.ENDED and was is not status:
                if self._player.failure:
                    self._client.refuse(self._player.failure)
                self._tell_state('')
            was = status
            # who leaps about all the time leaves others as much time as it takes
            await asyncio.sleep(max(PERIOD, time.monotonic() - now))

    def _looked(self, told: _Asked, now: float) -> list[tuple[str, int, bytes]]:
        """Do what was asked, and return what is due; in a thread of its own."""
        player = self._player
        with self._lock:
            if told.chosen is not None:
                self._chosen = told.chosen
                needed = self._transforms.needed(told.chosen)
                player.choose((told.chosen | needed) - self._offered.keys(), now)
            if told.seek is not None:
                player.seek(told.seek, now)
                self._transforms.forget()
            if told.rate is not None:
                player.set_rate(told.rate, now)
                (player.play if told.playing else player.pause)(now)
            for answer in told.answers:
                answer()
            return list(self._transforms.passed(self._player.due(now), self._chosen))

    def _subscribe(self, request: asked.Subscribe) -> None:
        by_number, add = self._channels.by_number, self._client.subscriptions.add
        told = [
            add(number, by_number[channel]) if channel in by_number
            else f'subscribe: there is no channel {channel}'
            for number, channel in request.channels.items()
        ]  # fmt: skip
        self._client.refuse_each([why for why in told if why])
        self._choose()

    def _unsubscribe(self, request: asked.Unsubscribe) -> None:
        told = [self._client.subscriptions.remove(number) for number in request.subscriptions]
        self._client.refuse_each([why for why in told if why])
        self._choose()

    def _choose(self) -> None:
        by_channel = self._client.subscriptions.by_channel.values()
        self._asked.chosen = frozenset(one.info.topic for _, one in by_channel)

    def _control(self, request: asked.Control) -> None:
        if not self._controls:
            msg = f'playback is controlled by the parameters {PLAYING}, {RATE} and {PLACE}'
            raise ProtocolError(msg)
        rate = request.speed or self._values()[RATE]  # without a speed it stays as it is
        require_rate(rate)
        self._change(request.playing, rate, request.seek, request.id)

    def _change(self, playing: bool, rate: float, seek: int | None, number: str) -> None:  # noqa: FBT001 - of the protocol
        loop = asyncio.get_running_loop()
        told = self._asked
        told.seek = told.seek if seek is None else seek
        told.rate, told.playing = rate, playing
        tell = partial(self._tell_state, number, seek is not None)
        told.answers.append(partial(loop.call_soon_threadsafe, tell))

    def _get(self, request: asked.GetParameters) -> None:
        values = self._values()
        names = request.names or list(values)
        self._client.refuse_each([
            f"no parameter '{name}'; there are {', '.join(values)}"
            for name in names if name not in values
        ])  # fmt: skip
        told = {name: values[name] for name in names if name in values}
        self._client.send(protocol.parameter_values(told, request.id))

    def _set(self, request: asked.SetParameters) -> None:
        values = self._values() | request.values
        unknown = sorted(values.keys() - {PLAYING, RATE, PLACE})
        if unknown:
            msg = f"no parameter '{unknown[0]}'; there are {PLAYING}, {RATE}, {PLACE}"
            raise ProtocolError(msg)
        place = request.values.get(PLACE)
        number = isinstance(place, (int, float)) and not isinstance(place, bool)
        length = (self._room.contents.span[1] - self._room.contents.span[0]) / SECOND
        if place is not None and not (number and 0.0 <= place <= length):
            msg = f'{PLACE} = {str(place)[:40]}: must lie in [0, {length:.3f}] s'
            raise ProtocolError(msg)
        require_rate(values[RATE])
        if not isinstance(values[PLAYING], bool):
            msg = f'{PLAYING} = {str(values[PLAYING])[:40]}: must be true or false'
            raise ProtocolError(msg)
        seek = None if place is None else self._room.contents.span[0] + round(place * SECOND)
        self._change(values[PLAYING], float(values[RATE]), seek, '')
        if request.id:
            self._client.send(protocol.parameter_values(values, request.id))

    def _values(self) -> dict[str, Any]:
        """Return what the parameters are when all that was asked for is done."""
        now, asked_for = time.monotonic(), self._asked
        place = self._player.position(now) if asked_for.seek is None else asked_for.seek
        seconds = (place - self._room.contents.span[0]) / SECOND
        if asked_for.rate is not None:
            return {PLAYING: asked_for.playing, RATE: asked_for.rate, PLACE: seconds}
        playing = self._player.status(now) is PlaybackStatus.PLAYING
        return {PLAYING: playing, RATE: float(self._player.rate), PLACE: seconds}

    def _tell_state(self, number: str, leapt: bool = False) -> None:  # noqa: FBT001, FBT002
        """Tell where playback stands, in the client's own way."""
        now = time.monotonic()
        if self._controls:
            self._client.send(
                protocol.playback_state(
                    self._player.status(now), self._player.position(now), self._player.rate,
                    leapt=leapt, number=number,
                )
            )  # fmt: skip
        if self._watched:
            self._client.send(protocol.parameter_values(self._values()))
