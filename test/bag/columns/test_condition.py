"""Conditions as they are written: what they mean, and what is refused before a bag is open."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.bag.columns.condition import Condition, begins, condition
from agv_motion.errors import ConfigurationError


@pytest.mark.parametrize(('text', 'found'), [
    ('/a/b > 0.02', Condition('/a/b', None, '>', '0.02')),
    ('/a[3]<=-1e3', Condition('/a', 3, '<=', '-1e3')),
    ("/state == 'on stop'", Condition('/state', None, '==', 'on stop')),
    ('  /state ~ stop ', Condition('/state', None, '~', 'stop')),
    ('/ranges == inf', Condition('/ranges', None, '==', 'inf')),
    ('/stuck >= true', Condition('/stuck', None, '>=', 'true')),
])  # fmt: skip
def test_they_are_read_as_they_are_written(text, found):
    assert condition(text) == found
    assert condition(str(found)) == found


@pytest.mark.parametrize('text', ['/a > nan', '/a >= inf', '/a < -inf', '/a <= high', '/a > 1 2'])
def test_an_order_needs_a_finite_number(text):
    with pytest.raises(ConfigurationError, match='takes a finite number'):
        condition(text)


@given(st.lists(st.booleans(), max_size=20), st.booleans())
def test_beginnings_are_where_it_was_not_met_just_before(met, before):
    found = begins(np.array(met, bool), before=before).tolist()
    assert found == [now and not last for last, now in zip([before, *met], met, strict=False)]
