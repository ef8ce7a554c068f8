"""What people ask for, and what they are told."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from agv_motion.bag import BagReader
from agv_motion.bag.editing import request
from agv_motion.bag.editing.request import EditRequest
from agv_motion.bag.selection import Selection
from agv_motion.errors import ConfigurationError, SourceError

_SPEC = importlib.util.spec_from_file_location('bags', Path(__file__).with_name('bags.py'))
bags = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(bags)
SECOND, told = bags.SECOND, bags.told


@pytest.fixture(scope='module')
def walk(tmp_path_factory):
    return bags.write(tmp_path_factory.mktemp('sources') / 'walk')


def resolved(walk, **asked):
    with BagReader(walk) as bag:
        return EditRequest(**asked).resolve([bag])


def test_times_are_those_of_the_bag(walk):
    what, notes = resolved(walk, begin='1', end='-1.9')
    assert (what.spans, notes) == (((101 * SECOND, 102 * SECOND),), ())
    what, _ = resolved(walk, end='00:01:42')
    assert what.spans == ((0, 102 * SECOND),)


def test_times_of_several_bags_reach_from_the_first_to_the_last(walk, tmp_path):
    """100 to 103.9 s, and 200 to 200.9 s."""
    later = bags.write(tmp_path / 'later', start=200, count=10)
    for order in ((walk, later), (later, walk)):
        with BagReader(order[0]) as one, BagReader(order[1]) as other:
            what, _ = EditRequest(begin='1', end='-0.5').resolve([one, other])
        assert what.spans == ((101 * SECOND, 200_400_000_000),)


def test_windows_around_what_happened_are_told(walk):
    what, notes = resolved(walk, around='/a ~ 12', before=0.1, after=0.2, begin='0.5')
    stamp = 100 * SECOND + 12 * SECOND // 10
    assert what.spans == ((stamp - SECOND // 10, stamp + SECOND // 5 + 1),)
    assert notes == ("'/a ~ 12' was met in 1 messages, 1 times on end: 1.100 to 1.400 s",)


def test_of_many_windows_the_first_are_told_from_the_start_of_the_bag(walk):
    """One message of /a in 0.3 s, from the first on; all of them meet it, on end."""
    what, (note,) = resolved(walk, around='/a ~ word')
    assert what.spans == tuple(
        (start, start + 1) for start in range(100 * SECOND, 104 * SECOND, 3 * SECOND // 10)
    )
    told_of = ', '.join(f'{k}.{n} to {k}.{n} s' for k, n in (
        (0, '000'), (0, '300'), (0, '600'), (0, '900'), (1, '200')))  # fmt: skip
    assert note == f"'/a ~ word' was met in 14 messages, 1 times on end: {told_of} and 9 more"
    _, (note,) = resolved(walk, around='/a == "word 0"', before=0.5)
    assert note.endswith('was met in 1 messages, 1 times on end: -0.500 to 0.000 s')


def test_times_reach_into_the_bag_at_their_very_limits(walk):
    """From 100 s to 103.9 s."""
    what, _ = resolved(walk, begin='3.9')
    assert what.spans == ((103_900_000_000, 2**64),)
    what, _ = resolved(walk, end='0.000000001')
    assert what.spans == ((0, 100_000_000_001),)
    for asked in ({'begin': '3.900000001'}, {'end': '0'}):
        with pytest.raises(ConfigurationError, match='nothing was recorded from'):
            resolved(walk, **asked)
    with pytest.raises(ConfigurationError, match='expected the earlier one first'):
        resolved(walk, begin='1', end='1')


def test_parts_begin_at_multiples_of_their_duration(walk, monkeypatch):
    what, _ = resolved(walk, part_duration=1.5, begin='1')
    assert [(a / SECOND, b / SECOND) for a, b in what.parts] == [(101.0, 102.5), (102.5, 104.0)]
    what, _ = resolved(walk, part_duration=2.0)
    assert [(a / SECOND, b / SECOND) for a, b in what.parts] == [(100.0, 102.0), (102.0, 104.0)]
    assert (resolved(walk)[0].parts, resolved(walk, part_size=1.5)[0].file_size) == ((), 1_500_000)
    monkeypatch.setattr(request, 'MOST_PARTS', 2)
    assert len(resolved(walk, part_duration=2.0)[0].parts) == 2
    with pytest.raises(ConfigurationError, match=r'^3 files of 1\.9 s each: expected at most 2; '):
        resolved(walk, part_duration=1.9)


@pytest.mark.parametrize(('asked', 'words'), [
    ({'begin': '10'}, r'walk reaches from @100.000 to @103.900'),
    ({'begin': '2', 'end': '1'}, 'expected the earlier one first'),
    ({'begin': 'x'}, 'is no moment'), ({'around': '/a ~ nothing'}, 'was never met'),
    ({'topics': Selection(topics=('/aa',))}, "did you mean '/a'"),
    ({'topics': Selection(regex='zzz')}, 'no topic is left'),
    ({'part_duration': 1e-6}, 'choose a longer time'),
    ({'topics': Selection(everything=True, exclude_topics=('/q',))}, "no topic '/q'"),
])  # fmt: skip
def test_what_does_not_fit_the_bag_is_refused(walk, asked, words):
    with pytest.raises(ConfigurationError, match=words):
        resolved(walk, **asked)


def test_a_bag_is_made_beside_and_nothing_is_overwritten(walk, tmp_path):
    target = tmp_path / 'deep' / 'new'
    shares = []
    outcome = EditRequest(begin='1').make([walk], target, shares.append)
    assert outcome.report.messages == len(told(target)) == 30
    assert 0.0 <= outcome.took < 60.0
    assert outcome.after == sum(file.stat().st_size for file in target.iterdir())
    assert outcome.before == next(walk.glob('*.mcap')).stat().st_size
    assert shares[-1] <= 1.0
    before = {p: p.read_bytes() for p in target.iterdir()}
    with pytest.raises(SourceError, match='File exists'):
        EditRequest().make([walk], target)
    assert {p: p.read_bytes() for p in target.iterdir()} == before
    assert list(target.parent.iterdir()) == [target]


def test_a_failure_leaves_nothing_and_is_an_outcome(walk, tmp_path):
    outcome = EditRequest(begin='99').run(walk, tmp_path / 'new')
    assert outcome.report is None
    assert 'nothing was recorded' in outcome.failure
    assert not list(tmp_path.iterdir())
    assert 0.0 <= outcome.took < 60.0
    lost = EditRequest().lost(walk, 'gone')
    assert lost == (str(walk), '', None, 0.0, 0, 0, (), (), 'gone')
    assert (EditRequest().modules(), EditRequest().apart()) == ((), False)


def test_a_full_disk_leaves_nothing(walk, tmp_path, monkeypatch):
    from agv_motion.bag.mcap.output import McapOutput

    def full(self, chunk):
        raise OSError(28, 'No space left on device')

    monkeypatch.setattr(McapOutput, 'put_chunk', full)
    with pytest.raises(SourceError, match='No space left on device'):
        EditRequest().make([walk], tmp_path / 'new')
    assert not list(tmp_path.iterdir())
