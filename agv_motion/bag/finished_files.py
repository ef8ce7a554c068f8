"""The files of a bag in the making that are whole, and the metadata that tells of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag import metadata

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.bag.mcap.writer import McapWriter


class Finished(NamedTuple):
    """A file of the bag that is whole, and how many messages each of its topics has."""

    summary: metadata.FileSummary
    counts: tuple[int, ...]


class FinishedFiles:
    """Keeps ``metadata.yaml`` true, whatever is on the disk when the power fails."""

    def __init__(self, folder: Path, ros_distro: str) -> None:
        """Begin with no file.

        Args:
            folder: Of the bag.
            ros_distro: Name of the ROS distribution, for the metadata.

        """
        self._folder, self._ros_distro = folder, ros_distro
        self.topics: list[metadata.Topic] = []
        """of the bag, in the order in which they were added"""
        self.files: list[Finished] = []
        self.deleted: list[int] = []
        """messages of each topic that were in files which :meth:`drop_oldest` deleted"""

    def add_topic(self, topic: metadata.Topic) -> None:
        """Note a topic."""
        self.topics.append(topic)
        self.deleted.append(0)

    def counts(self, present: McapWriter) -> list[int]:
        """Return the messages of each topic in these files and in the present one."""
        files = [file.counts for file in self.files]
        if not present.closed:
            files.append(tuple(present.counts))
        return self._sums(files)

    def save(self, present: McapWriter) -> None:
        """Describe these files and name the present one, which a kill would leave torn.

        A reader that goes by the names then meets the torn file, and cannot miss what is in it.

        Raises:
            OSError: The disk is full.

        """
        files = list(self.files)
        if not present.closed:
            files.append(
                Finished(
                    metadata.FileSummary(present.path.name, metadata.NEVER, metadata.NEVER, 0), ()
                )
            )
        metadata.save(self._folder, self._described(files))

    def close(self, present: McapWriter) -> None:
        """Finish the present file, which then is one of these.

        Raises:
            OSError: The disk is full.

        """
        total = sum(present.counts)
        summary = metadata.FileSummary(present.path.name, present.start, present.end, total)
        this = Finished(summary, tuple(present.counts))
        files = [*self.files, this]
        metadata.save(self._folder, self._described(files))
        present.close({'serialized_metadata': metadata.inside_mcap(self._described([this]))})
        self.files = files

    def drop_oldest(self, present: McapWriter) -> bool:
        """Delete the oldest file; return whether there was one."""
        if not self.files:
            return False
        oldest = self.files.pop(0)
        path = self._folder / oldest.summary.path
        try:
            self.save(present)  # first, so that it never names what is gone
            path.unlink(missing_ok=True)
        except OSError:  # no room for it on the disk, but soon there is
            path.unlink(missing_ok=True)
            self.save(present)
        for i, count in enumerate(oldest.counts):
            self.deleted[i] += count
        return True

    def _described(self, files: list[Finished]) -> str:
        topics = zip(self.topics, self._sums([file.counts for file in files]), strict=True)
        return metadata.describe([file.summary for file in files], topics, self._ros_distro)

    def _sums(self, counts: list[tuple[int, ...]]) -> list[int]:
        """Return the sum for each topic; files before a topic was added do not count it."""
        return [sum(c[i] for c in counts if i < len(c)) for i in range(len(self.topics))]
