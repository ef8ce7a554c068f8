"""What nodes log: the text of others is seen in it, and the place is that of the node."""

from __future__ import annotations

import pytest
from rclpy.impl.logging_severity import LoggingSeverity

from agv_motion.ros.visible_logger import VisibleLogger


@pytest.fixture
def logger():
    return VisibleLogger('test_visible_logger')


def test_text_of_others_is_never_obeyed(logger, capfd):
    assert logger.warning('STOP: \x1b[2J\u202eyes\r[INFO] all is well')
    assert 'STOP: \\x1b[2J\\u202eyes\\x0d[INFO] all is well' in ''.join(capfd.readouterr())
    assert logger.error(ValueError('\x9b1m'))
    assert '\\u009b1m' in ''.join(capfd.readouterr())


def test_the_place_is_that_of_whoever_logs(logger, capfd):
    """By it rclpy counts what is said seldom: two lines do not silence each other."""
    for text in ('one', 'one'):
        logger.info(text, once=True)
    logger.info('two', once=True)
    said = ''.join(capfd.readouterr())
    assert said.count('one') == said.count('two') == 1
    assert {place.file_path for place in logger.contexts} == {__file__}


def test_a_level_that_is_off_logs_nothing(logger, capfd):
    logger.set_level(LoggingSeverity.ERROR)
    try:
        assert not logger.warning('quiet')
    finally:
        logger.set_level(LoggingSeverity.UNSET)
    assert 'quiet' not in ''.join(capfd.readouterr())
