"""What a topic lost on its way, judged by the numbers and the times its publishers gave."""

from __future__ import annotations

MOST_PUBLISHERS = 64
"""of which the numbers of one topic are told apart"""


class SequenceGaps:
    """Follows the messages of one topic.

    Each publisher numbers its messages 1, 2, 3, ... but a message does not say whose it is. A
    number is taken to be a new publisher's while not all of them are known, and else to follow the
    highest number below it. So of several publishers whose numbers run close together a gap may
    go unseen; of one publisher, none does.
    """

    def __init__(self) -> None:
        """Start before the first message."""
        self.messages = 0
        self.lost = 0
        """messages whose numbers never came; those before the first one do not count"""
        self.longest_silence = 0
        """[ns] between two messages, by the time of sending"""
        self.first, self.last = 0, 0
        """[ns] time of sending of the first and of the last message"""
        self.publishers = 1
        """how many there are on the graph"""
        self._expected: list[int] = []

    def see(self, sequence: int, sent: int) -> None:
        """Take note of a message.

        Args:
            sequence: Its publisher's number of it; 0 where there is none.
            sent: [ns] when it was sent.

        """
        if self.messages:
            silence = sent - self.last
            self.longest_silence = max(self.longest_silence, silence)
        else:
            self.first = sent
        self.messages += 1
        self.last = max(self.last, sent)
        expected = self._expected
        if len(expected) == 1 and sequence == expected[0]:
            expected[0] += 1
        elif sequence:
            self._follow(sequence)

    def interrupt(self) -> None:
        """Take what comes next as a new beginning: what went by meanwhile is not lost."""
        self._expected.clear()

    @property
    def rate(self) -> float:
        """Messages per second, by the times of sending; 0 for fewer than two."""
        span = self.last - self.first
        return (self.messages - 1) * 1e9 / span if span else 0.0

    def _follow(self, sequence: int) -> None:
        """Let ``sequence`` follow the publisher whose next number is closest below it."""
        expected = self._expected
        nearest = max((number for number in expected if number <= sequence), default=0)
        if nearest and (nearest == sequence or len(expected) >= self.publishers):
            expected.remove(nearest)
            self.lost += sequence - nearest
        elif len(expected) == MOST_PUBLISHERS:
            return
        expected.append(sequence + 1)
