"""Reservations as messages, and back."""

from __future__ import annotations

import json
import random
from math import inf, nan

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import Point
from visualization_msgs.msg import Marker

from agv_motion.errors import SignalError
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.reservation import MessageId, Reservation
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.ros.reservations import reservation_message, reservation_of

STAMP = 1_430_438_400_100_000_001

CLAIM = Reservation(
    'oak', MessageId(2**64 - 1, 12), 1.48, ((1.0, 2.0), (3.0, 2.0)), ((3.0, 2.0), (3.0, 4.0)),
    ((3.0, 4.0), (8.0, 9.0), (9.0, 9.0)), 17, {'ash': MessageId(2**63 + 1, 42)}, parked=False,
    margin=0.2,
)  # fmt: skip


def _set(change):
    """Return what changes the text of the first marker."""

    def act(message):
        told = json.loads(message.markers[0].text)
        change(told)
        message.markers[0].text = json.dumps(told)

    return act


@pytest.mark.parametrize(
    'reservation',
    [CLAIM, Reservation('ash', MessageId(7, 0), 0.4, ((1.0, 2.0),), received={}, parked=True)],
)
def test_there_and_back(reservation):
    assert reservation_of(reservation_message(reservation, 'map', STAMP), 'map') == reservation


def test_its_corridor_is_as_wide_as_the_tree():
    strip = reservation_message(CLAIM, 'map', STAMP).markers[0]
    assert strip.scale.x == pytest.approx(2.96)
    assert (strip.header.stamp.sec, strip.header.stamp.nanosec) == divmod(STAMP, 10**9)
    assert strip.header.frame_id == 'map'


@pytest.mark.parametrize(
    ('change', 'word'),
    [
        (lambda m: m.markers.pop(), 'no reservation of a tree'),
        (lambda m: setattr(m.markers[0], 'text', '{}'), 'expected run, number'),
        (lambda m: setattr(m.markers[0], 'text', 'hello'), 'expected run, number'),
        (lambda m: setattr(m.markers[0].points[0], 'x', nan), 'must be finite'),
        (lambda m: setattr(m.markers[0].scale, 'x', 0.0), 'must be positive'),
        (lambda m: setattr(m.markers[0].header, 'frame_id', 'odom'), "expected 'map'"),
        (lambda m: setattr(m.markers[2].header, 'frame_id', 'odom'), "expected 'map'"),
        (lambda m: m.markers.append(m.markers[2]), '4 markers are no reservation'),
        (lambda m: setattr(m.markers[0].pose.position, 'x', 1.0), 'relative to a pose'),
        (lambda m: setattr(m.markers[0], 'points', [Point()] * 1_000_000), '1000000 points'),
        (lambda m: setattr(m.markers[0].points[0], 'x', 1e300), 'must be finite and within'),
        (lambda m: setattr(m.markers[0], 'text', '[' * 50_000), 'expected run, number'),
        (lambda m: setattr(m.markers[0], 'text', '7' * 99_999), 'expected run, number'),
        (lambda m: setattr(m.markers[0], 'text', ' ' * 100_001), '100001 characters'),
        (lambda m: [setattr(x, 'ns', '') for x in m.markers], 'needs name'),
        (lambda m: [setattr(x, 'ns', '  ') for x in m.markers], 'needs name'),
        (_set(lambda told: told.pop('run')), 'expected run, number'),
        (_set(lambda told: told.update(number=1.5)), 'expected run, number'),
        (_set(lambda told: told.update(number=-1)), 'must lie in'),
        (_set(lambda told: told.update(journey=float('inf'))), 'expected run, number'),
        (_set(lambda told: told.update(margin=nan)), 'margin nan'),
        (_set(lambda told: told.update(parked='no')), 'expected run, number'),
        (_set(lambda told: told.update(heard={'ash': [1]})), 'expected run, number'),
        (_set(lambda told: told.update(heard=[])), 'expected run, number'),
    ],
)
def test_what_is_no_reservation_is_refused(change, word):
    message = reservation_message(CLAIM, 'map', STAMP)
    change(message)
    with pytest.raises(SignalError, match=word):
        reservation_of(message, 'map')


NUMBERS = (nan, inf, -inf, 0.0, -1.0, 1e-300, 1e9, 1e300, 2.5)
TEXTS = ('', ' ', 'oak', 'x' * 300, '\x00', 'null', '[[', '{"run": 1}', '1e999')


def _spoilt(chance):
    """Return the message of a sound reservation with one to three things in it changed."""
    message = reservation_message(CLAIM, 'map', STAMP)
    for _ in range(chance.randint(1, 3)):
        marker = chance.choice(message.markers) if message.markers else Marker()
        told = json.loads(CLAIM_TEXT)
        key = chance.choice([*told, 'other'])
        told[key] = chance.choice([*NUMBERS, *TEXTS, None, [], {}, -1, 2**64, 2**63, True, [1, 2],
                                   {'ash': [1, 2]}, {'ash': [nan, 2]}, {'': [1, 1]}])  # fmt: skip
        point = Point(x=chance.choice(NUMBERS), y=chance.choice(NUMBERS))
        chance.choice([
            lambda m=marker, t=told: setattr(m, 'text', json.dumps(t)),
            lambda m=marker: setattr(m, 'text', chance.choice(TEXTS)),
            lambda m=marker: setattr(m, 'ns', chance.choice(TEXTS)),
            lambda m=marker: setattr(m, 'id', chance.randint(-1, 3)),
            lambda m=marker, p=point: setattr(m, 'points', [p] * chance.choice((0, 1, 2, 5000))),
            lambda m=marker: setattr(m.scale, 'x', chance.choice(NUMBERS)),
            lambda m=marker: setattr(m.header, 'frame_id', chance.choice(TEXTS)),
            lambda m=marker: message.markers.append(m),
            lambda: message.markers.pop() if message.markers else None,
        ])()  # fmt: skip
    return message


CLAIM_TEXT = reservation_message(CLAIM, 'map', STAMP).markers[0].text


def test_whatever_a_message_says_it_is_refused_or_leaves_the_tree_sound():
    chance = random.Random(1)  # noqa: S311 - seeded, no secret
    ash = RightOfWay('ash', (20.0, 0.0), TrafficParameters(listen=0.0), 42)
    refused = 0
    for number in range(1500):
        try:
            ash.receive(reservation_of(_spoilt(chance), 'map'), float(number))
        except SignalError:
            refused += 1
        if not ash.requested:
            ash.request((ash.held[-1], (20.0, 5.0)))
        ash.settle(float(number))
        reservation_of(reservation_message(ash.reservation(float(number)), 'map', STAMP), 'map')
    assert 250 < refused < 1500
