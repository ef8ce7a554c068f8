"""Refusals are told at once, then ever more seldom, and counted."""

from __future__ import annotations

from agv_motion.ros.refusals import KINDS, LATEST, Refusals


def told(refusals, reasons, times):
    return [line for reason, now in zip(reasons, times, strict=True)
            if (line := refusals.line(reason, now))]  # fmt: skip


def test_a_repeat_is_counted_and_told_after_pauses_that_double():
    refusals = Refusals()
    lines = {now: refusals.line('x: nan', now) for now in (n / 10 for n in range(101))}
    assert {now: line for now, line in lines.items() if line} == {
        0.0: 'x: nan',
        1.0: 'x: nan (9 more like it since)',
        3.0: 'x: nan (19 more like it since)',
        7.0: 'x: nan (39 more like it since)',
    }


def test_a_fault_that_lasts_a_night_is_told_once_a_minute():
    lines = told(Refusals(), ['x: nan'] * 36000, range(36000))
    assert len(lines) < 36000 / LATEST + 10


def test_numbers_make_no_new_reason_but_words_do():
    refusals = Refusals()
    assert refusals.line('x = 1.25: too large', 0.0)
    assert not refusals.line('x = 7.5: too large', 0.0)
    assert refusals.line('y = 7.5: too large', 0.0)


def test_however_many_reasons_there_are_the_log_stays_short():
    names = [f'{"abcdefghij"[n % 10]}{"klmnopqrst"[n // 10 % 10] * (n // 100 + 1)}'
             for n in range(5000)]  # fmt: skip
    assert len(told(Refusals(), names, [0.0] * 5000)) <= KINDS + 1


def test_what_is_told_together_is_not_counted_as_alike():
    refusals = Refusals()
    told(refusals, ['a' * n for n in range(1, KINDS + 10)], [0.0] * (KINDS + 9))
    assert refusals.line('one of its own', 1.0) == 'one of its own (8 others since)'


def test_reasons_that_are_over_make_room_for_others():
    refusals = Refusals()
    told(refusals, ['a' * n for n in range(1, 100)], [0.0] * 99)
    assert refusals.line('new', 10 * LATEST)
    assert refusals.line('newer', 10 * LATEST)
