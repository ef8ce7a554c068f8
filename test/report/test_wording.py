"""Numbers and times as people say them."""

from __future__ import annotations

import pytest

from agv_motion.report.wording import in_words, sentence, span_in_words


@pytest.mark.parametrize(
    ('number', 'word'),
    [(0, 'no'), (1.4, 'one'), (12, 'twelve'), (20, 'twenty'), (21, '21'), (-1, '-1')],
)
def test_whole_numbers_up_to_twenty_are_words(number, word):
    assert in_words(number) == word


@pytest.mark.parametrize(
    ('seconds', 'words'),
    [(45.0, '45 seconds'), (89.0, '89 seconds'), (91.0, 'two minutes'), (720.0, 'twelve minutes'),
     (3590.0, 'an hour'), (3659.0, 'an hour'), (5400.0, '90 minutes'), (7200.0, 'two hours'),
     (86400.0, '24 hours')],
)  # fmt: skip
def test_a_time_is_told_in_its_usual_unit(seconds, words):
    assert span_in_words(seconds) == words


def test_a_sentence_begins_with_a_capital_and_keeps_all_others():
    assert sentence('the Ghost waits') == 'The Ghost waits'
    assert sentence('') == ''
