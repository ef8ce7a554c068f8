"""Claims as messages, and back."""

from __future__ import annotations

from math import nan

import pytest

pytest.importorskip('rclpy')

from agv_motion.errors import SignalError
from agv_motion.motion.traffic.claim import Claim
from agv_motion.ros.claims import claim_message, claim_of

CLAIM = Claim(
    'oak', 1_700_000_000_123_456_789, 1.58, ((1.0, 2.0), (3.0, 2.0)), ((3.0, 2.0), (3.0, 4.0)),
    ((3.0, 4.0), (8.0, 9.0), (9.0, 9.0)), 1_699_999_999_000_000_001, {'ash': 42}, parked=False,
)  # fmt: skip


@pytest.mark.parametrize(
    'claim', [CLAIM, Claim('ash', 7, 0.4, ((1.0, 2.0),), heard={}, parked=True)]
)
def test_there_and_back(claim):
    assert claim_of(claim_message(claim, 'map'), 'map') == claim


def test_its_corridor_is_as_wide_as_the_tree():
    strip = claim_message(CLAIM, 'map').markers[0]
    assert strip.scale.x == pytest.approx(3.16)
    assert strip.header.frame_id == 'map'


@pytest.mark.parametrize(
    ('change', 'word'),
    [
        (lambda m: m.markers.pop(), 'no claim of a tree'),
        (lambda m: setattr(m.markers[0], 'text', '{}'), 'expected journey'),
        (lambda m: setattr(m.markers[0], 'text', 'hello'), 'expected journey'),
        (lambda m: setattr(m.markers[0].points[0], 'x', nan), 'must be finite'),
        (lambda m: setattr(m.markers[0].scale, 'x', 0.0), 'must be positive'),
        (lambda m: setattr(m.markers[0].header, 'frame_id', 'odom'), "expected 'map'"),
    ],
)
def test_what_is_no_claim_is_refused(change, word):
    message = claim_message(CLAIM, 'map')
    change(message)
    with pytest.raises(SignalError, match=word):
        claim_of(message, 'map')
