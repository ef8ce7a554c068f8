"""One name is a list of one, and times are whole nanoseconds."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.bag.request import FOREVER, listed, span_of, whole
from agv_motion.errors import ConfigurationError


def test_one_name_alone_is_a_list_of_one():
    assert listed('/odom') == ['/odom']
    assert listed(iter(('/odom', '/tf'))) == ['/odom', '/tf']


def test_a_span_without_limits_is_all_time_and_nothing_lies_before_1970():
    assert span_of(None, None) == (0, FOREVER)
    assert span_of(-5, 7) == (0, 7)


@pytest.mark.parametrize('time', [1.5, True, '7', np.float64(3.0)])
def test_a_time_that_is_no_whole_number_is_refused(time):
    with pytest.raises(ConfigurationError, match=r'start = .*give whole nanoseconds'):
        span_of(time, None)
    assert whole('start', np.int64(7)) == 7
