"""Some messages of a channel, and where in the file they come from."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from agv_motion.bag.columns.batch import Batch, place_in_file

ORIGINS = [(0, 1000), (40, 5000), (90, 5100)]
"""Three chunks: from byte 0, 40 and 90 of the buffer on."""


@pytest.mark.parametrize(
    ('place', 'origin'),
    [(0, 1000), (39, 1000), (40, 5000), (89, 5000), (90, 5100), (500, 5100)],
)
def test_a_place_comes_from_the_last_origin_before_it(place, origin):
    assert place_in_file(ORIGINS, place) == origin


def test_a_part_keeps_its_rows_together():
    starts = np.array([4, 44, 94])
    batch = Batch(3, b'', starts, starts + 1, starts + 2, starts + 3, Path('x'), ORIGINS)
    part = batch.part(slice(1, 3))
    assert part.starts.tolist() == [44, 94]
    assert part.sizes.tolist() == [45, 95]
    assert part.forms.tolist() == [46, 96]
    assert part.stamps.tolist() == [47, 97]
    assert [batch.origin(row) for row in range(3)] == [1000, 5000, 5100]
    assert [part.origin(row) for row in range(2)] == [5000, 5100]
