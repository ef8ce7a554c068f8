"""What is refused of the parameters of events, and where events go."""

from __future__ import annotations

from pathlib import Path

import pytest

from agv_motion.bag.events.event_parameters import EventParameters
from agv_motion.errors import ConfigurationError


@pytest.mark.parametrize(('text', 'words'), [
    ('/residual', 'is no condition'), ('/a > nan', 'finite'), ('/a < inf', 'finite'),
    ('/a > big', "takes a finite number, not 'big'"),
])  # fmt: skip
def test_a_trigger_that_is_none_is_refused_at_once(text, words):
    with pytest.raises(ConfigurationError, match=words) as caught:
        EventParameters(trigger=('/state ~ stopped', text))
    assert text in str(caught.value)


def test_ranges():
    with pytest.raises(ConfigurationError, match='before'):
        EventParameters(before=float('nan'))
    with pytest.raises(ConfigurationError, match='expected at most 100'):
        EventParameters(trigger=('/a > 1',) * 101)


def test_the_folder_is_the_same_for_every_recording_beside_each_other():
    given = EventParameters()
    assert given.events_folder(Path('/bags/one')) == Path('/bags/events')
    assert given.events_folder(Path('/bags/two')) == Path('/bags/events')
    assert EventParameters(events='/kept').events_folder(Path('/bags/one')) == Path('/kept')
