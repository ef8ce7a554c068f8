"""Messages quote no more than 200 characters, and keep their remedy."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import LONGEST, QUOTED, AgvMotionError, SignalError, SourceError, shortened


@pytest.mark.parametrize(
    ('before', 'after'),
    [
        (f"frame '{'x' * 5000}': expected 'map'; transform it",
         f"frame '{'x' * QUOTED}... (4800 characters more)': expected 'map'; transform it"),
        (f'joints {["y"] * 200}: name wheels',
         f'joints {str(["y"] * 200)[:QUOTED + 1]}... (798 characters more)]: name wheels'),
        (f"its robot's {'w ' * 150} 'frame'", f"its robot's {'w ' * 150} 'frame'"),
        (f"frame '{'x' * QUOTED}': expected 'map'", f"frame '{'x' * QUOTED}': expected 'map'"),
    ],
)  # fmt: skip
def test_a_quotation_ends_and_the_remedy_stays(before, after):
    assert shortened(before) == after


@pytest.mark.parametrize('kind', [AgvMotionError, SignalError, SourceError])
def test_errors_are_shortened(kind):
    error = kind(f'too long: {"word " * 10_000}: say less')
    assert len(str(error)) < LONGEST
    assert str(error).endswith('say less')


@given(st.lists(st.text(max_size=20), min_size=1, max_size=5), st.integers(1, LONGEST))
def test_no_message_is_longer(parts, times):
    """Of parts that are said once, and again and again: to draw each letter takes much longer."""
    for message in (''.join(part * times for part in parts), ''.join(parts) * times):
        assert len(shortened(message)) <= LONGEST


@given(st.text(max_size=QUOTED))
def test_short_ones_stay(message):
    assert shortened(message) == message
