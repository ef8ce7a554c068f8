"""How much goes into a chunk."""

from __future__ import annotations

from math import inf, nan

import pytest

from agv_motion.bag.chunk_limits import chunk_limits
from agv_motion.errors import ConfigurationError


def test_seconds_become_nanoseconds_and_for_ever_stays():
    assert chunk_limits(1000, 0.5) == (1000, 500_000_000)
    assert chunk_limits(1, inf) == (1, inf)


@pytest.mark.parametrize('given', [(0, 1.0), (1, 0.0), (1, -1.0), (1, nan)])
def test_what_is_not_positive_is_refused(given):
    with pytest.raises(ConfigurationError, match='both must be positive'):
        chunk_limits(*given)
