"""What clients of the live endpoint ask, done or refused in words."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.core.names import robot_of
from agv_motion.dashboard.foxglove import protocol
from agv_motion.dashboard.foxglove import requests as asked
from agv_motion.dashboard.foxglove.parsing import parsed
from agv_motion.dashboard.foxglove.permissions import HAND, READ_ONLY
from agv_motion.dashboard.foxglove.protocol import CDR
from agv_motion.dashboard.foxglove.requests import ProtocolError
from agv_motion.dashboard.server.drive import OTHER
from agv_motion.dashboard.server.foxglove.client import MOST_CHANNELS

if TYPE_CHECKING:
    from asyncio import Future
    from collections.abc import Callable

    from agv_motion.dashboard.foxglove.requests import ClientChannel
    from agv_motion.dashboard.server.foxglove.client import FoxgloveClient
    from agv_motion.dashboard.server.foxglove.hub import FoxgloveHub
    from agv_motion.dashboard.server.foxglove.parameters import FoxgloveParameters
    from agv_motion.dashboard.server.site import Site

ZERO = bytes(48)
"""The end of every twist that is at rest, stamped or not: six numbers"""
NO_ASSETS = 'no files are given out here'
LIVE = 'this is live: nothing can be played, paused or sought'


class FoxgloveDesk:
    """Does what clients ask."""

    def __init__(self, site: Site, hub: FoxgloveHub, parameters: FoxgloveParameters) -> None:
        """Serve the clients of a hub.

        Args:
            site: Knows who drives robots by hand.
            hub: Has the clients.
            parameters: Of the robots.

        """
        self._site, self._hub, self._parameters = site, hub, parameters
        self._acts: dict[type[Any], Callable[[FoxgloveClient, Any], None]] = {
            asked.Subscribe: self._subscribe,
            asked.Unsubscribe: self._unsubscribe,
            asked.Publish: self._publish,
            asked.Advertise: self._advertise,
            asked.Unadvertise: _unadvertise,
            asked.Call: lambda client, told: client.begin(hub.services.call(client, told)),
            asked.GetParameters: lambda client, told: client.begin(parameters.get(client, told)),
            asked.SetParameters: lambda client, told: client.begin(parameters.set(client, told)),
            asked.WatchParameters: self._watch_parameters,
            asked.WatchGraph: self._watch_graph,
            asked.FetchAsset: lambda client, told: client.send(
                protocol.asset_refusal(told.id, NO_ASSETS)
            ),
            asked.Control: lambda client, _: client.refuse(LIVE),
        }

    def hear(self, client: FoxgloveClient, message: str | bytes) -> None:
        """Do what a client asks; what cannot be done is told to it."""
        try:
            request = parsed(message)
            self._acts[type(request)](client, request)
        except ProtocolError as error:
            client.refuse(error)

    def _unsubscribe(self, client: FoxgloveClient, request: asked.Unsubscribe) -> None:
        told = [client.subscriptions.remove(number) for number in request.subscriptions]
        client.refuse_each([why for why in told if why])
        self._hub.want()

    def _watch_parameters(self, client: FoxgloveClient, request: asked.WatchParameters) -> None:
        self._parameters.watch(client, request)
        self._hub.want()

    def _watch_graph(self, client: FoxgloveClient, request: asked.WatchGraph) -> None:
        client.watches_graph, client.graph = request.on, protocol.NO_GRAPH
        self._hub.want()

    def _subscribe(self, client: FoxgloveClient, request: asked.Subscribe) -> None:
        by_number, add = self._hub.channels.by_number, client.subscriptions.add
        told = [
            add(number, by_number[channel]) if channel in by_number
            else f'subscribe: there is no channel {channel}'
            for number, channel in request.channels.items()
        ]  # fmt: skip
        client.refuse_each([why for why in told if why])
        self._hub.want()

    def _advertise(self, client: FoxgloveClient, request: asked.Advertise) -> None:
        told = []
        for channel in request.channels:
            why = _advertised(client, channel)
            if why:
                told.append(why)
            else:
                ready = self._hub.source.prepare(channel.topic, channel.type)
                ready.add_done_callback(lambda done: _tell_failure(client, done))
        client.refuse_each(told)

    def _publish(self, client: FoxgloveClient, request: asked.Publish) -> None:
        channel = client.published.get(request.channel)
        if channel is None:
            client.refuse(f'there is no channel {request.channel} of yours: advertise it first')
            return
        robot = robot_of(channel.topic[: -len(HAND) - 1])
        if channel.topic.endswith(f'/{HAND}'):
            self._require_alone(client, robot, moves=not request.data.endswith(ZERO))
        out = self._hub.source.publish(channel.topic, channel.type, request.data)
        out.add_done_callback(lambda done: _tell_failure(client, done))

    def _require_alone(self, client: FoxgloveClient, robot: str, *, moves: bool) -> None:
        """Refuse a second hand while the first one moves, here or on the page."""
        now, drivers = time.monotonic(), self._site.drivers
        hand, moved = drivers.get(robot, (client, 0.0))
        if moves and hand is not client and now - moved < OTHER:
            msg = f'another person drives {robot}'
            raise ProtocolError(msg)
        if moves:
            drivers[robot] = client, now


def _unadvertise(client: FoxgloveClient, request: asked.Unadvertise) -> None:
    client.refuse_each([
        f'unadvertise: there is no channel {number} of yours'
        for number in request.channels if client.published.pop(number, None) is None
    ])  # fmt: skip


def _advertised(client: FoxgloveClient, channel: ClientChannel) -> str:
    """Let a client publish on a channel; return why it may not."""
    if channel.id in client.published:
        return f'advertise: channel {channel.id} is yours already: unadvertise it first'
    if len(client.published) >= MOST_CHANNELS:
        return f'advertise: {MOST_CHANNELS} channels are yours: unadvertise one first'
    if not client.permissions.acts:
        return f'advertise: {READ_ONLY}'
    if channel.encoding != CDR:
        return f"advertise {channel.topic}: encoding '{channel.encoding}': only {CDR} is taken"
    why = client.permissions.refuses_topic(channel.topic, channel.type)
    if why:
        return f'advertise: {why}'
    client.published[channel.id] = channel
    return ''


def _tell_failure(client: FoxgloveClient, done: Future[str]) -> None:
    if not done.cancelled() and done.exception() is not None:
        client.refuse(done.exception())
