"""The serial source on a real pseudo-terminal."""

from __future__ import annotations

import os
import time
from contextlib import suppress
from datetime import datetime, timezone
from math import isnan
from types import SimpleNamespace

import pytest

from agv_motion.errors import SignalError
from agv_motion.probe.sources import attempts, serial_line
from agv_motion.probe.sources.line_reading import read_line_of, sample_of
from agv_motion.probe.sources.serial_line import SerialParameters, SerialSource

LINE = '24-06-15 13:05:30 0.750 0.760 0.770\r\n'


def parse_line(text, given):
    return sample_of(text, read_line_of(text, given, 0.0), given)


@pytest.fixture
def terminal():
    """Return a pair: the end of the logger, and the name of the port."""
    logger, port = os.openpty()
    name = os.ttyname(port)
    yield logger, name
    for end in (logger, port):
        with suppress(OSError):
            os.close(end)


def until(source, count, timeout=60.0, now=0.0):
    """Return ``count`` samples, read without waiting, again and again."""
    samples, end = [], time.monotonic() + timeout
    while len(samples) < count and time.monotonic() < end:
        samples += source.read(now)
    return samples


def test_lines_become_samples(terminal):
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port))
    assert source.read(0.0) == []
    os.write(logger, (LINE + LINE[:20]).encode())
    (sample,) = until(source, 1)
    moment = datetime(2015, 6, 24, 13, 5, 30, tzinfo=timezone.utc)
    assert sample.time == moment.timestamp()
    assert sample.values == pytest.approx((18.75, 19.0, 19.25))
    os.write(logger, LINE[20:].encode())
    assert len(until(source, 1)) == 1


def test_an_unreadable_line_is_told_and_the_next_one_read(terminal):
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port))
    source.read(0.0)
    os.write(logger, b'\xff\x00 rubbish\n' + LINE.encode())
    assert len(until(source, 1)) == 1
    assert 'rubbish' in source.complaint()
    assert source.complaint() == ''


def test_control_characters_round_the_text_and_any_line_end_do_no_harm(terminal):
    """As the original's logger sends them: NUL before the text, EOT and NUL after it."""
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port))
    source.read(0.0)
    text = LINE.strip().encode()
    for line in (
        b'\x00\x00' + text + b'\x04\n',
        b'\x04' + text + b'\x00\x00\r\n',
        b'\x04\n\x00\r' + text + b'\r',
        b'\x02' + text + b'\x03\x04\n',
    ):
        os.write(logger, line)
        (sample,) = until(source, 1)
        assert sample == parse_line(LINE.strip(), SerialParameters())
    assert source.complaint() == ''


@pytest.mark.parametrize('value', ['1e308', '-1e308', '9' * 400, '1e999', 'inf', '5e5'])
@pytest.mark.parametrize('unit', ['K', 'mV', 'V', 'uV'])
def test_no_number_of_a_line_becomes_infinite(terminal, value, unit):
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port, unit=unit, kelvin_per_millivolt=1e4))
    source.read(0.0)
    os.write(logger, f'24-06-15 13:05:30 {value} {value} 0.0\n'.encode())
    (sample,) = until(source, 1)
    assert all(isnan(value) for value in sample.values[:2])
    assert sample.values[2] == 0.0


def test_decimal_commas_are_read_and_told_once(terminal):
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port))
    source.read(0.0)
    for told in (True, False):
        os.write(logger, b'24-06-15 13:05:30 0,750 0,760 0,770\n')
        (sample,) = until(source, 1)
        assert sample.values == pytest.approx((18.75, 19.0, 19.25))
        assert ('decimal commas' in source.complaint()) is told


def test_a_logger_whose_day_is_another_is_told_until_it_is_set(terminal):
    """The US logger's 06-10-13 is the sixth of October here: 118 days ahead of the clock."""
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port))
    source.read(0.0)
    now = datetime(2013, 6, 10, 12, 30, tzinfo=timezone.utc).timestamp()
    for line, count, word in (
        (b'06-10-13 12:30:00 1 2 3\n', 1, '118 days ahead of the clock here'),
        (b'06-10-13 12:30:01 1 2 3\n', 1, ''),
        (b'10-06-13 12:30:00 1 2 3\n' * 2, 1, 'left out'),
        (b'10-06-13 12:30:01 1 2 3\n', 1, ''),
        (b'08-06-13 12:30:00 1 2 3\n' * 2, 1, '2 days behind the clock here'),
    ):
        os.write(logger, line)
        assert len(until(source, count, now=now)) == count
        complaint = source.complaint()
        assert word in complaint
        assert bool(complaint) == bool(word)


def test_a_line_with_the_time_of_another_month_is_left_out(terminal):
    """One would make the probes forget their nights, and rest for two days."""
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port))
    source.read(0.0)
    noon = datetime(2013, 6, 10, 12, 0, tzinfo=timezone.utc).timestamp()
    os.write(
        logger,
        b'10-06-13 12:00:00 1 2 3\n11-05-13 12:00:30 1 2 3\n'
        b'10-06-13 12:01:00 1 2 3\n10-07-69 12:01:30 1 2 3\n10-06-13 12:02:00 1 2 3\n',
    )
    samples = until(source, 3, now=noon)
    assert [sample.time - noon for sample in samples] == [0.0, 60.0, 120.0]
    complaint = source.complaint()
    assert "the time of '11-05-13 12:00:30 1 2 3' does not go on" in complaint
    assert "the time of '10-07-69 12:01:30 1 2 3' does not go on" in complaint


def test_many_broken_lines_are_counted(terminal):
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port))
    source.read(0.0)
    os.write(logger, b'rubbish\n' * 50 + LINE.encode())
    assert len(until(source, 1)) == 1
    complaint = source.complaint()
    assert complaint.count('rubbish') <= 3
    assert 'more' in complaint


def test_rubbish_without_end_is_dropped(terminal):
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port))
    source.read(0.0)
    for _ in range(6):
        os.write(logger, b'x' * 400)
        assert until(source, 1, timeout=0.02) == []
    os.write(logger, ('\n' + LINE).encode())
    assert len(until(source, 1)) == 1


def test_a_line_that_goes_away_is_opened_again(tmp_path, wait_until):
    logger, port = os.openpty()
    link = tmp_path / 'logger'
    link.symlink_to(os.ttyname(port))
    source = SerialSource(SerialParameters(port=str(link)))
    source.read(0.0)
    os.close(port)
    os.close(logger)
    complaints = []

    def complains():
        source.read(0.0)
        complaints.append(source.complaint())
        return complaints[-1]

    wait_until(complains)
    assert 'not readable' in complaints[-1]
    logger, port = os.openpty()
    link.unlink()
    link.symlink_to(os.ttyname(port))

    def speaks():
        os.write(logger, LINE.encode())
        return source.read(0.0)

    wait_until(speaks)
    source.close()


def test_a_port_that_is_not_there_is_told():
    source = SerialSource(SerialParameters(port='/dev/no_such_port'))
    assert source.read(0.0) == []
    assert 'check cable and permissions' in source.complaint()


def test_pauses_grow_until_the_line_is_there_and_then_begin_anew(monkeypatch):
    """Tries at 0, 1, 3 and 7 s; the line is there at 7 s, gone at once, and tried a second on."""
    now, opened = SimpleNamespace(seconds=0.0), []

    def gone(*_, **__):
        opened.append(now.seconds)
        if now.seconds != 7.0:
            raise OSError(5, 'gone')
        return SimpleNamespace(read=gone_too, close=lambda: None)

    def gone_too(_):
        raise OSError(5, 'gone')

    monkeypatch.setattr(attempts.wall, 'monotonic', lambda: now.seconds)
    monkeypatch.setattr(serial_line.serial, 'Serial', gone)
    source = SerialSource(SerialParameters(port='/dev/anything'))
    for quarter in range(44):
        now.seconds = quarter / 4
        source.read(0.0)
    assert opened == [0.0, 1.0, 3.0, 7.0, 8.0, 10.0]


def test_the_clock_of_the_logger_may_be_elsewhere():
    summer = parse_line(LINE, SerialParameters(utc_offset=2.0))
    assert summer.time == parse_line(LINE, SerialParameters()).time - 7200.0


def test_fields_are_chosen_and_may_be_broken():
    sample = parse_line('24-06-15 13:05:30 1 x 3', SerialParameters(fields=(3, 2, 1), unit='K'))
    assert sample.values[0] == 3.0
    assert isnan(sample.values[1])


@pytest.mark.parametrize(
    ('line', 'word'),
    [('24-06-15 13:05:30 1 2', 'field 3 is missing'), ('2015-06-24 1 2 3', 'expected DD-MM-YY')],
)
def test_lines_of_another_form_are_quoted(line, word):
    with pytest.raises(SignalError, match=word) as error:
        parse_line(line, SerialParameters())
    assert line in str(error.value)


def test_silence_is_told_once_with_what_came_last(terminal):
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port, period=10.0))
    source.read(0.0)
    assert source.complaint() == ''
    source.read(31.0)
    assert source.complaint().startswith(f'nothing has come in 31 s from {port} at 38400 baud')
    os.write(logger, LINE.encode())
    until(source, 1, now=40.0)
    source.complaint()
    source.read(69.0)
    assert source.complaint() == ''
    for _ in range(2):
        source.read(71.0)
    assert source.complaint() == f"nothing has come for 31 s; the last was '{LINE.strip()}'"


def test_bytes_that_are_no_text_hint_at_the_speed_of_the_line(terminal):
    logger, port = terminal
    source = SerialSource(SerialParameters(port=port))
    source.read(0.0)
    os.write(logger, b'\xf3\x8f\xe1\xd0a\n' + LINE.encode())
    until(source, 1)
    assert 'it is no text: 38400 baud may not be its speed' in source.complaint()


def test_the_air_stands_in_fields_of_its_own():
    given = SerialParameters(fields=(3, 1), radiation_field=2, vpd_field=4, unit='K')
    sample = parse_line('24-06-15 13:05:30 18.5 512.0 19.5 0.8', given)
    assert sample.values == (19.5, 18.5)
    assert sample.environment == (512.0, 0.8)
    with pytest.raises(SignalError, match='probe field 4 is missing'):
        parse_line('24-06-15 13:05:30 18.5 512.0 19.5', given)
    assert all(each != each for each in parse_line(LINE, SerialParameters()).environment)  # noqa: PLR0124 - NaN
