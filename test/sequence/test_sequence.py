"""What to do when an action fails: words and what they mean."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.sequence.sequence import OnFailure


@pytest.mark.parametrize(
    ('words', 'meaning', 'again'),
    [
        ('stop', OnFailure(0, skip=False), 'stop'),
        (' skip ', OnFailure(0, skip=True), 'skip'),
        ('retry 3', OnFailure(3, skip=False), 'retry 3'),
        ('retry 3 then stop', OnFailure(3, skip=False), 'retry 3'),
        ('retry 2 then skip', OnFailure(2, skip=True), 'retry 2 then skip'),
        ('retry 0 then skip', OnFailure(0, skip=True), 'skip'),
    ],
)
def test_words_and_back(words, meaning, again):
    assert OnFailure.parse(words) == meaning
    assert str(meaning) == again
    assert OnFailure.parse(again) == meaning


@pytest.mark.parametrize(
    'words', ['', 'Stop', 'retry', 'retry -1', 'retry 1.5', 'retry 1 then', 'retry 9999999', 'go']
)
def test_others_are_refused_with_those_that_there_are(words):
    with pytest.raises(ConfigurationError, match=f"'{words}': choose one of stop, skip, retry N"):
        OnFailure.parse(words)
