"""Messages late, lost and doubled, by numbers."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from agv_motion.simulation.radio import Radio, RadioParameters

NAMES = ['ash', 'elm', 'oak']


def word(name, number=0):
    return SimpleNamespace(name=name, number=number)


def test_all_others_hear_it_in_time_and_the_sender_does_not():
    radio = Radio(NAMES, RadioParameters(loss=0.0, delay=2.0), 1)
    sent = word('ash')
    radio.send(sent, 10.0)
    assert radio.receive(10.0) == []
    assert sorted(name for name, _ in radio.receive(12.0)) == ['elm', 'oak']
    assert radio.receive(99.0) == []


def test_without_delay_it_is_there_at_once_and_earlier_ones_first():
    radio = Radio(NAMES, RadioParameters(loss=0.0, delay=0.0), 1)
    radio.send(word('ash', 2), 2.0)
    radio.send(word('ash', 1), 1.0)
    assert [(name, w.number) for name, w in radio.receive(2.0)] == [
        ('elm', 1), ('oak', 1), ('elm', 2), ('oak', 2),
    ]  # fmt: skip


@pytest.mark.parametrize(('loss', 'doubled', 'heard'), [(0.3, 0.0, 0.7), (0.0, 0.5, 1.5)])
def test_shares_are_lost_and_doubled(loss, doubled, heard):
    radio = Radio(NAMES, RadioParameters(loss=loss, delay=0.0, doubled=doubled), 1)
    for _ in range(2000):
        radio.send(word('ash'), 0.0)
    assert len(radio.receive(0.0)) / 4000 == pytest.approx(heard, abs=0.04)


def test_those_who_are_deaf_to_each_other_hear_nothing():
    radio = Radio(NAMES, RadioParameters(loss=0.0, delay=0.0), 1)
    radio.deaf.add(('ash', 'elm'))
    radio.send(word('ash'), 0.0)
    radio.send(word('elm'), 0.0)
    assert [name for name, _ in radio.receive(0.0)] == ['oak', 'ash', 'oak']


def test_order_may_change_on_the_way():
    radio = Radio(['ash', 'elm'], RadioParameters(loss=0.0, delay=2.0), 1)
    for number in range(20):
        radio.send(word('ash', number), 0.1 * number)
    numbers = [w.number for _, w in radio.receive(99.0)]
    assert sorted(numbers) == list(range(20)) != numbers
