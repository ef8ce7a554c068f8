"""A bag in the making out of chunks that are ready: a folder of MCAP files and its metadata."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.bag import metadata
from agv_motion.bag.editing.new_channels import topic_of
from agv_motion.bag.mcap.channels import from_channel
from agv_motion.bag.mcap.output import McapOutput

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from agv_motion.bag.editing.new_channels import NewChannels
    from agv_motion.bag.mcap.output import NewChunk
    from agv_motion.bag.mcap.records import Attachment, Metadata


class NewBag:
    """Writes chunks into files, each of which describes all channels.

    It is made beside its place, and moved there when it is whole: nothing waits for the disk.
    """

    def __init__(self, folder: Path, channels: NewChannels, profile: str = 'ros2') -> None:
        """Create the folder and its first file.

        Args:
            folder: Of the bag; it must not exist.
            channels: All that any chunk has messages of.
            profile: What the messages are.

        """
        self._folder, self._channels, self._profile = folder, channels, profile
        self._files: list[McapOutput] = []
        folder.mkdir()
        self._open()

    @property
    def messages(self) -> int:
        """Number of messages so far."""
        return sum(sum(file.channel_counts.values()) for file in self._files)

    @property
    def file_size(self) -> int:
        """[bytes] of the present file."""
        return self._files[-1].size

    @property
    def file_count(self) -> int:
        """Number of files so far."""
        return len(self._files)

    def put(self, chunk: NewChunk) -> None:
        """Append a chunk."""
        self._files[-1].put_chunk(chunk)

    def keep(self, extra: Attachment | Metadata) -> None:
        """Append an attachment or named strings."""
        self._files[-1].keep(extra)

    def next_file(self) -> None:
        """Go on in a new file, if the present one has messages."""
        if any(self._files[-1].channel_counts.values()):
            self._close(self._files[-1])
            self._open()

    def close(self) -> None:
        """Finish the last file, unless it is empty and others are not, and write the metadata."""
        last = self._files[-1]
        if len(self._files) > 1 and not any(last.channel_counts.values()):
            last.abandon()
            last.path.unlink()
            self._files.pop()
        else:
            self._close(last)
        metadata.save(self._folder, self._described(self._files))

    def abandon(self) -> None:
        """Let go of the present file."""
        self._files[-1].abandon()

    def _open(self) -> None:
        path = self._folder / f'{self._folder.name}_{len(self._files)}.mcap'
        file = McapOutput(path, self._profile)
        self._files.append(file)
        for schema in self._channels.schemas.values():
            file.add_schema(schema)
        for channel in self._channels.channels.values():
            file.add_channel(channel)

    def _close(self, file: McapOutput) -> None:
        told = metadata.inside_mcap(self._described([file]))
        file.close({'serialized_metadata': told}, sync=False)

    def _described(self, files: Iterable[McapOutput]) -> str:
        """Return the metadata of some files; channels of the same topic and type are one topic."""
        topics: dict[tuple[str, str], tuple[metadata.Topic, int]] = {}
        counts = [file.channel_counts for file in files]
        for number, channel in self._channels.channels.items():
            topic = topic_of(from_channel(channel, self._channels.schemas))
            known, before = topics.get((topic.name, topic.type), (None, 0))
            if known is not None:
                topic = known._replace(qos=tuple(dict.fromkeys((*known.qos, *topic.qos))))
            messages = before + sum(count[number] for count in counts)
            topics[topic.name, topic.type] = topic, messages
        summaries = [
            metadata.FileSummary(file.path.name, file.start, file.end, sum(count.values()))
            for file, count in zip(files, counts, strict=True)
        ]
        return metadata.describe(summaries, topics.values())
