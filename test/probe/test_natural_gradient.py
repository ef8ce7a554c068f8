"""The natural gradient of a stem, taken from heated probes."""

from __future__ import annotations

from math import inf, isnan, nan

import pytest

from agv_motion.probe.natural_gradient import without_natural_gradient


def test_it_is_taken_from_each_by_hand():
    """The stem is 0.5 K warmer at the heated needle: that much of 18.5 K is not heating."""
    assert without_natural_gradient((18.5, 0.5, 17.25), 1) == (18.0, 0.5, 16.75)
    assert without_natural_gradient((18.5, -0.5), 1) == (19.0, -0.5)


@pytest.mark.parametrize('gradient', [nan, inf, -inf, 5.1, -5.1])
def test_what_cannot_be_believed_leaves_nothing_to_believe(gradient):
    first, second, third = without_natural_gradient((18.5, gradient, 17.0), 1)
    assert isnan(first)
    assert isnan(third)
    assert second == gradient or isnan(gradient)
