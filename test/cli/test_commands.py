"""Every command over bags that are damaged, odd or foreign.

launch_scripts/fuzz/fuzz_commands.py is the long form. Here some bags of the kinds that once gave
a wrong answer, a traceback or none at all.
"""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip('rclpy')

import fuzz_commands

ONCE_WRONG = (
    'an empty chunk',  # times that no index tells of were rounded to 256 ns
    'no chunks: a bit in message',  # nobody looked at the CRC of the data
    'statistics: messages of a channel 7',  # counts by topic that do not sum up
    'metadata names one file twice',
    'sqlite3: no data',
    "messages in 'json'",  # nor that an error named the bag
)
TRIED_ELSEWHERE = (
    'cut', 'filter', 'merge', 'split', 'convert', 'compress', 'sort', 'du', 'note',  # fuzz_bags.py
    'list', 'errors',
)  # fmt: skip
SLOW = 'replay', 'plot', 'bag plot', 'calibrate', 'reprocess', 'bag hz header', 'bag info names'


@pytest.fixture(scope='module')
def trial(tmp_path_factory):
    return fuzz_commands.Trial(tmp_path_factory.mktemp('trial'), without=SLOW)


@pytest.mark.parametrize('name', ONCE_WRONG)
def test_an_answer_is_right_or_an_error_with_file_and_place(trial, name, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert trial.judge(name, fuzz_commands.cases()[name], seed=1) == []


def test_all_commands_that_read_bags_are_tried():
    tried = fuzz_commands.commands(Path(), Path(), [], Path()).values()
    found = {tuple(fuzz_commands.verb(' '.join(words[:2]))) for words in tried}
    assert found | {('bag', name) for name in TRIED_ELSEWHERE} == set(fuzz_commands.readers())
    assert len(fuzz_commands.cases()) > 200
