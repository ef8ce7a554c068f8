"""When something happened in a bag: the times at which a field met a condition."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.columns.condition import begins, meets
from agv_motion.bag.columns.field_name import topic_and_field
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.bag.columns.condition import Condition
    from agv_motion.bag.reader import BagReader


class Happenings(NamedTuple):
    """When a condition was met."""

    events: int
    """how many times it began to be met"""
    stamps: NDArray[Any]
    """[ns] log times of all messages that met it, in order"""


def happenings(bag: BagReader, wanted: Condition) -> Happenings:
    """Return when a condition was met.

    Raises:
        ConfigurationError: There is no such field, or it cannot be compared with such a value.
        SourceError: The bag is damaged.

    """
    topic, field = topic_and_field(bag, wanted.name)
    columns = read_topic(bag, topic, [field] if field else None)
    try:
        met = meets(wanted, columns.fields, named=bool(field))
    except ConfigurationError as error:
        msg = f'bag {bag.path}: {error}'
        raise ConfigurationError(msg) from None
    order = np.argsort(columns.stamps, kind='stable')
    met = met[order]
    return Happenings(int(begins(met).sum()), columns.stamps[order][met])


def windows(
    stamps: Sequence[int] | NDArray[Any], before: int, after: int
) -> tuple[tuple[int, int], ...]:
    """Return the times around moments: from ``before`` to ``after`` each [ns], overlapping joined.

    Args:
        stamps: [ns] in order.
        before: [ns] that each window begins earlier.
        after: [ns] that it goes on, the moment included.

    """
    found: list[tuple[int, int]] = []
    for stamp in map(int, stamps):
        start, stop = max(stamp - before, 0), stamp + after + 1
        if found and start <= found[-1][1]:
            found[-1] = found[-1][0], stop
        else:
            found.append((start, stop))
    return tuple(found)
