"""What one client has asked for and has been sent: no socket, so that it can be tried without."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.dashboard.foxglove.frames import message_header

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.dashboard.foxglove.channels import LiveChannel, Said


class Subscriptions:
    """The channels that a client has chosen, each with the number that it gave it."""

    def __init__(self) -> None:
        """Choose none."""
        self.by_channel: dict[int, tuple[int, LiveChannel]] = {}
        """number of the subscription, and the channel, by the number of the channel"""
        self._channel_of: dict[int, int] = {}
        self._new: list[LiveChannel] = []
        """channels whose slots it has never had"""
        self._served = 0
        """number of the newest message that it has had"""
        self._behind = False

    def add(self, number: int, channel: LiveChannel) -> str:
        """Choose a channel; return why that cannot be, or nothing."""
        if number in self._channel_of:
            return f'subscription {number} is there already: unsubscribe first'
        if channel.info.id in self.by_channel:
            return f'{channel.info.topic} is subscribed already, as {self.number_of(channel)}'
        self._channel_of[number] = channel.info.id
        self.by_channel[channel.info.id] = number, channel
        if channel.latched and channel.slots:
            self._new.append(channel)
        return ''

    def number_of(self, channel: LiveChannel) -> int:
        """Return the number of the subscription to a channel that is chosen."""
        return self.by_channel[channel.info.id][0]

    def remove(self, number: int) -> str:
        """Choose a channel no more; return why that cannot be, or nothing."""
        channel = self._channel_of.pop(number, None)
        if channel is None:
            return f'there is no subscription {number}'
        self._forget(channel)
        return ''

    def drop(self, channel: int) -> None:
        """Forget a channel that is gone."""
        if channel in self.by_channel:
            number, _ = self.by_channel[channel]
            del self._channel_of[number]
            self._forget(channel)

    def _forget(self, channel: int) -> None:
        _, gone = self.by_channel.pop(channel)
        self._new = [one for one in self._new if one is not gone]

    @property
    def is_behind(self) -> bool:
        """Whether there is something that it has not had."""
        return self._behind or bool(self._new)

    def skip(self) -> None:
        """Send nothing this time: the client has not taken what it was sent before."""
        self._behind = True

    def frames(self, fresh: Iterable[LiveChannel], count: int) -> list[bytes]:
        """Return what is to be sent, as pieces of frames; it counts as sent.

        Args:
            fresh: Channels that have news since the last look.
            count: Number of the newest message of all.

        """
        parts: list[bytes] = []
        late, self._new = self._new, []
        for channel in late:
            _write(parts, self.number_of(channel), channel.slots)
        if self._behind:
            served = self._served
            for number, channel in self.by_channel.values():
                if channel not in late:
                    _write(parts, number, [one for one in channel.slots if one.number > served])
        else:
            by_channel = self.by_channel
            for channel in fresh:
                chosen = by_channel.get(channel.info.id)
                if chosen is not None and channel not in late:
                    _write(parts, chosen[0], channel.fresh)
        self._served, self._behind = count, False
        return parts


def _write(parts: list[bytes], number: int, messages: Iterable[Said]) -> None:
    head, add = message_header, parts.append
    for _, stamp, data in messages:
        add(head(number, stamp, len(data)))
        add(data)
