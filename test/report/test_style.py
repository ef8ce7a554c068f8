"""One hand for all figures: numbers in short, silences, lines of many points."""

from __future__ import annotations

import numpy as np

from agv_motion.report import style


def test_many_numbers_at_one_place_are_told_in_short():
    places = [(0.1 * i, 0.0) for i in range(8)] + [(5.0, 0.0)]
    numbers = [name.replace('\u2009', '') for _, _, name in style.grouped(places, 0.9)]
    assert numbers == ['1·…·7·8', '9']
    assert [name for *_, name in style.grouped(places, 0.9, 8)] == ['9']


def test_a_line_is_not_joined_over_a_silence():
    time, values = style.broken([0.0, 1.0, 2.0, 30.0, 31.0], [1.0, 2.0, 3.0, 4.0, 5.0])
    assert (
        np.isnan(time).tolist() == np.isnan(values).tolist() == [False] * 3 + [True] + [False] * 2
    )
    assert len(style.broken([0.0, 20.0, 40.0], [1.0, 2.0, 3.0])[0]) == 3  # usual there
    assert len(style.broken([0.0], [1.0])[0]) == 1


def test_a_long_line_is_thinned_and_keeps_its_spikes():
    values = np.zeros(100_000)
    values[77_777], values[5], values[6] = 9.0, -3.0, np.nan
    time, kept = style.thinned(np.arange(100_000.0), values)
    assert len(time) <= style.MOST_POINTS
    assert (kept.max(), kept.min(), time[kept.argmax()]) == (9.0, -3.0, 77_777.0)
