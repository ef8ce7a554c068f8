"""The serial source on a real pseudo-terminal."""

from __future__ import annotations

import os
import time
from contextlib import suppress
from datetime import datetime, timezone
from math import isnan

import pytest

from agv_motion.errors import SignalError
from agv_motion.probe.sources.serial_line import SerialParameters, SerialSource, parse_line

LINE = '24-06-15 13:05:30 0.750 0.760 0.770\r\n'


@pytest.fixture
def terminal():
    """Return a pair: the end of the logger, and the name of the port."""
    logger, port = os.openpty()
    name = os.ttyname(port)
    yield logger, name
    for end in (logger, port):
        with suppress(OSError):
            os.close(end)


def until(source, count, timeout=60.0):
    """Return ``count`` samples, read without waiting, again and again."""
    samples, end = [], time.monotonic() + timeout
    while len(samples) < count and time.monotonic() < end:
        samples += source.read(0.0)
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
