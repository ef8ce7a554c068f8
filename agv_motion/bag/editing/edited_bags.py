"""The bags of an edit: refused unless sound, what is attached to them, and what came of them."""

from __future__ import annotations

from collections import Counter
from hashlib import sha256
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap.records import Attachment

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from agv_motion.bag.mcap.records import Metadata
    from agv_motion.bag.reader import BagReader


class EditReport(NamedTuple):
    """What was done."""

    messages: int
    copied: int
    """chunks that are as they were"""
    made: int
    """chunks that are new"""
    files: int


def require_sound(bags: Iterable[BagReader], *, whole: bool) -> None:
    """Refuse bags in which something is known to be damaged.

    Args:
        bags: Open.
        whole: All of each is wanted: compare it with the CRC of the whole, where it has one.

    Raises:
        SourceError: One of them.

    """
    for bag in bags:
        for problem in bag.problems:
            if not getattr(problem, 'harmless', False):
                raise problem
        for file in bag.files if whole else ():
            file.require_whole()


def extras(bags: Iterable[BagReader]) -> Iterator[Attachment | Metadata]:
    """Yield attachments and named strings of all bags, once where several have the same.

    Raises:
        DamagedBagError: One is damaged.

    """
    kept: Counter[bytes] = Counter()
    for bag in bags:
        mine: Counter[bytes] = Counter()
        for file in bag.files:
            for extra in file.extras():
                if isinstance(extra, DamagedBagError):
                    raise extra
                if isinstance(extra, Attachment) or extra.name != 'rosbag2':
                    key = _digest(extra)
                    mine[key] += 1
                    if mine[key] > kept[key]:
                        yield extra
        kept |= mine


def _digest(extra: Attachment | Metadata) -> bytes:
    if not isinstance(extra, Attachment):
        return sha256(repr((extra.name, sorted(extra.entries.items()))).encode()).digest()
    about = repr(extra[:-1]).encode()
    return sha256(about).digest() + sha256(extra.data).digest()
