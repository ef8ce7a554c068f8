"""A recording: messages are handed over in no time and written by a thread of its own.

Whoever receives messages must not wait for the disk, or the next ones are lost. The thread flushes
every half second, splits files, drops old ones, and stops clearly when the disk is full.
"""

from __future__ import annotations

import errno
import shutil
import threading
from collections import deque
from contextlib import suppress
from dataclasses import dataclass, field
from math import inf
from time import monotonic
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.completeness import NOTHING, Completeness, as_record
from agv_motion.bag.quality_of_service import kept
from agv_motion.bag.recording.sequence_gaps import SequenceGaps
from agv_motion.bag.recording.storage_parameters import MEGABYTE, FullDisk
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import AgvMotionError, SourceError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from agv_motion.bag.metadata import FileSummary
    from agv_motion.bag.quality_of_service import OfferedQos
    from agv_motion.bag.recording.storage_parameters import StorageParameters

PERIOD = 0.02
"""[s] at which the thread looks for messages"""

MOST_LATCHED = 100
"""messages of a latched topic that are repeated in a new file"""


class QueuedMessage(NamedTuple):
    """A message as it comes from the middleware."""

    topic: int
    received: int
    data: bytes
    sent: int
    sequence: int


class TopicReport(NamedTuple):
    """What became of a topic."""

    name: str
    messages: int
    """that are in the bag, those of a latched topic that begin a new file again included"""
    rate: float
    """[Hz] by the times of sending"""
    lost: int
    """messages that its publishers numbered and that never came"""
    dropped: int
    """messages for which the disk was too slow, or full"""
    longest_silence: float
    """[s]"""
    deleted: int
    """messages that were in the oldest files, which gave way to newer ones"""


@dataclass
class _Topic:
    name: str
    latest: deque[QueuedMessage]
    """what a latched topic tells a late listener"""
    gaps: SequenceGaps = field(default_factory=SequenceGaps)
    dropped: int = 0
    told: Completeness = NOTHING
    """what the finished files tell"""

    def so_far(self) -> Completeness:
        """Return what became of its messages; a dropped one leaves a gap in the numbers too."""
        lost = max(self.gaps.lost - self.dropped, 0)
        return Completeness(self.gaps.messages, lost, self.dropped)


class Recording:
    """One bag in the making. One thread may use it; :meth:`put` never makes it wait."""

    def __init__(self, path: Path, given: StorageParameters) -> None:
        """Create the bag and start to write.

        Args:
            path: Folder of the bag; it must not exist.
            given: How to write it.

        Raises:
            SourceError: The folder exists, or cannot be made.

        """
        self.path = path
        self.failure = ''
        """why the recording ended by itself; empty while it goes on"""
        self.needed_from: float = inf
        """[ns] log time; a file that reaches beyond it stays, whatever ``keep_files`` says"""
        self.only_needed = False
        """whether the others go when a new file begins"""
        self._given = given
        self._writer = BagWriter(path, compression=given.compression)
        self._queue: deque[QueuedMessage] = deque()
        self._topics: list[_Topic] = []
        self._handed, self._taken = 0, 0
        self._limit = given.cache * MEGABYTE
        self._newest = 0
        self._split_at = inf
        self._flushed_at = monotonic()
        self._lock = threading.Lock()
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name='recording', daemon=True)
        self._thread.start()

    def add_topic(self, name: str, message_type: str, qos: Sequence[OfferedQos]) -> int:
        """Return the handle of a new topic.

        Raises:
            ConfigurationError: The type is not installed, or the topic is there already.
            SourceError: The disk is full or failed, and the recording has ended with a whole bag.

        """
        with self._lock:
            if self.failure:
                raise SourceError(self.failure)
            try:
                handle = self._writer.add_topic(name, message_type, qos=qos)
            except OSError as error:
                self._end(str(error.strerror or error))
                raise SourceError(self.failure) from error
            self._topics.append(_Topic(name, deque(maxlen=min(kept(qos), MOST_LATCHED))))
        return handle

    def set_publishers(self, topic: int, count: int) -> None:
        """Note how many publishers of a topic have been seen: each numbers its own messages."""
        self._topics[topic - 1].gaps.publishers = max(count, 1)

    def put(self, topic: int, received: int, data: bytes, sent: int, sequence: int = 0) -> None:
        """Hand over a message.

        Args:
            topic: Handle from :meth:`add_topic`.
            received: [ns] log time.
            data: In CDR.
            sent: [ns] by the clock of its publisher.
            sequence: Its publisher's number of it; 0: unknown.

        """
        if self.failure or self._handed - self._taken > self._limit:
            self._topics[topic - 1].dropped += 1
            return
        self._handed += len(data)
        self._queue.append(QueuedMessage(topic, received, data, sent, sequence))

    def interrupt(self) -> None:
        """Take what comes next as a new beginning: the messages of a pause are not lost."""
        with self._lock:
            for topic in self._topics:
                topic.gaps.interrupt()

    def split(self) -> None:
        """Go on in a new file, unless the recording is closed."""
        with self._lock:
            if not self._writer.closed:
                self._try(self._drain)
                self._try(self._split)

    def close(self) -> list[TopicReport]:
        """Write what was handed over, finish the bag, and tell what became of each topic."""
        self._ending.set()
        self._thread.join()
        with self._lock:
            self._try(self._drain)
            self._try(self._finish)
            if self._writer.discarded:
                self.failure += f'; the last {self._writer.discarded} messages found no room'
        for message in self._queue:
            self._topics[message.topic - 1].dropped += 1
        kept, deleted = self._writer.counts, self._writer.deleted
        return [_report(*each) for each in zip(self._topics, kept, deleted, strict=True)]

    def finished_files(self) -> list[FileSummary]:
        """Return the files that are whole."""
        with self._lock:
            return self._writer.finished_files

    @property
    def messages(self) -> int:
        """Number of messages handed over and taken so far."""
        return sum(topic.gaps.messages for topic in self._topics)

    @property
    def size(self) -> int:
        """Bytes of data taken so far, uncompressed."""
        return self._taken

    def _run(self) -> None:
        while not self._ending.wait(PERIOD) and not self.failure:
            with self._lock:
                self._try(self._drain)
                if monotonic() - self._flushed_at >= self._given.flush_period:
                    self._try(self._flush)

    def _try(self, act: Callable[[], None]) -> None:
        """Do ``act``; where it fails (the disk is full) the recording ends with a whole bag."""
        if self.failure:
            return
        try:
            act()
        except OSError as error:
            if error.errno == errno.ENOSPC and not self._writer.closed and self._drop_oldest():
                self._try(act)
                return
            self._end(str(error.strerror or error))
        except AgvMotionError as error:
            self._end(str(error))

    def _tell(self) -> None:
        """Write into the present file how complete its topics are."""
        if not self._topics or self._writer.closed:
            return
        now = [topic.so_far() for topic in self._topics]
        told: dict[str, Completeness] = {}
        for topic, one in zip(self._topics, now, strict=True):  # several of a name: other types
            told[topic.name] = told.get(topic.name, NOTHING).plus(one.since(topic.told))
        self._writer.flush(sync=False)
        self._writer.keep(as_record(told))
        for topic, one in zip(self._topics, now, strict=True):
            topic.told = topic.told.plus(one.since(topic.told))

    def _finish(self) -> None:
        self._tell()
        self._writer.close()

    def _end(self, reason: str) -> None:
        self.failure = f'recording {self.path} ended: {reason}'
        with suppress(OSError):  # it takes some bytes more, or not
            self._tell()
        with suppress(OSError):  # the same failure again; the bag is whole
            self._writer.close()

    def _drain(self) -> None:
        """Write what has been handed over."""
        queue, topics, write = self._queue, self._topics, self._writer.write
        for _ in range(len(queue)):
            message = queue.popleft()
            handle, received, data, sent, sequence = message
            topic = topics[handle - 1]
            topic.gaps.see(sequence, sent)
            self._newest = received
            self._taken += len(data)
            if received >= self._split_at:
                self._split()
            write(handle, received, data, sent, sequence & 0xFFFFFFFF)
            if self._split_at == inf and self._given.max_bag_duration:
                self._split_at = received + int(self._given.max_bag_duration * 1e9)
            if topic.latest.maxlen:
                topic.latest.append(message)
        if 0.0 < self._given.max_bag_size * MEGABYTE <= self._writer.file_size:
            self._split()

    def _flush(self) -> None:
        self._writer.flush(sync=self._given.sync)
        self._flushed_at = monotonic()
        floor = self._given.keep_free * MEGABYTE
        while shutil.disk_usage(self.path).free < floor:
            if not self._drop_oldest():
                reason = f'less than keep_free = {self._given.keep_free:g} MB of the disk is free'
                raise OSError(0, reason)

    def _split(self) -> None:
        """Go on in a new file, with the latched messages again: each file stands alone."""
        self._tell()
        self._writer.flush(sync=self._given.sync)
        self._writer.split()
        self._split_at = inf
        keep = 0 if self.only_needed else self._given.keep_files or inf
        while (files := self._writer.finished_files) and keep < len(files):
            if files[0].end >= self.needed_from or not self._writer.drop_oldest():
                break
        for topic in self._topics:
            for handle, _, data, sent, sequence in topic.latest:
                number = sequence & 0xFFFFFFFF
                self._writer.write(handle, self._newest, data, sent, number)

    def _drop_oldest(self) -> bool:
        drops = FullDisk(self._given.when_full) is FullDisk.DROP_OLDEST
        return drops and self._writer.drop_oldest()


def _report(topic: _Topic, kept: int, deleted: int) -> TopicReport:
    seen = topic.gaps
    silence = seen.longest_silence * 1e-9
    return TopicReport(topic.name, kept, seen.rate, seen.lost, topic.dropped, silence, deleted)
