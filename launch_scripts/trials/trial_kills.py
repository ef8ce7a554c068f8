"""End every command that writes at random moments: nothing half, nothing gone, a rerun completes.

    python launch_scripts/trials/trial_kills.py --moments 100
    python launch_scripts/trials/trial_kills.py --moments 300 --only 'reprocess on a cluster'

Each command is ended by kill -9, Ctrl-C, SIGTERM and a full disk, some by the death of a worker, at
moments that are spread over the changes of files that it makes, over the names and bytes that have
appeared, and over its time. Then must hold: what was there before is there, byte by byte; each
result is whole or absent, bags by the judgement of mcap's and rosbags' readers as well; no process
goes on; no traceback; status 0 only with all results; and the same command again completes, and
leaves nothing behind. `--by change` needs no clock and is the same on every machine. Exits with 1
where something does not hold; the folder is kept then.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import sys
import tempfile
from collections import Counter
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 100))
# shared memory left by a killed process can swallow messages of the next one on its port
os.environ.setdefault('FASTDDS_BUILTIN_TRANSPORTS', 'UDPv4')
os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')

import kill_judges
from kill_cases import Case, beside, cases, cluster, prepare
from kill_run import FULL, INTERRUPT, KILL, TERMINATE, WORKER, Moment, Way, run
from rich.progress import track

from agv_motion.ros.stop import interrupt

if TYPE_CHECKING:
    from collections.abc import Iterator

    from kill_judges import Files
    from kill_run import Ended


class Trial:
    """One command: an undisturbed run, and then as many that are ended."""

    def __init__(self, case: Case, folder: Path, sources: Path) -> None:
        """Run it undisturbed.

        Raises:
            RuntimeError: That does not end as it should.

        """
        self._case, self._work, self._sources = case, folder / 'work', sources
        self._kept = kill_judges.files(sources)
        before, ended, found = self._run(None)
        if ended.status != case.status:
            msg = f'{case.name}: undisturbed it ends with {ended.status}: {ended.told}'
            raise RuntimeError(msg)
        self._whole: Way = ended.way
        self._results = {
            n: c for n, c in found.items() if before.get(n) != c and n != kill_judges.INDEX
        }
        self._index = kill_judges.index(self._work) if case.indexed else []

    def moment(self, rng: random.Random, by: str) -> Moment:
        """Return a moment of the kinds that the command allows."""
        ways = [KILL, INTERRUPT, TERMINATE, *([WORKER] * self._case.worker)]
        kinds = ['change', 'change'] if self._case.forked else ['names', 'written']
        kinds.append('clock')
        if self._case.forked or self._case.bag:
            ways.append(FULL)
        kind = by if by in kinds else rng.choice(kinds)
        return Moment(rng.choice(ways), kind, rng.random())

    def faults(self, moment: Moment) -> Iterator[str]:
        """End a run at a moment, and yield what does not hold."""
        before, ended, found = self._run(moment)
        yield from self._of_the_end(ended)
        yield from self._of_what_was_there(before, found)
        if self._case.bag:
            yield from self._of_the_bag(moment, ended)
        else:
            yield from self._of_results(before, ended, found)
        yield from self._of_a_rerun(before, found)

    def _run(self, moment: Moment | None) -> tuple[Files, Ended, Files]:
        """Run in a fresh folder; return its files before, what came of it, and its files after."""
        shutil.rmtree(self._work, ignore_errors=True)
        self._work.mkdir(parents=True)
        for name, content in self._case.before:
            (self._work / name).parent.mkdir(parents=True, exist_ok=True)
            (self._work / name).write_bytes(content)
        for name in self._case.copies:
            source, copy = self._sources / name, self._work / name
            (shutil.copytree if source.is_dir() else shutil.copy2)(source, copy)
        before = kill_judges.files(self._work)
        whole = None if moment is None else self._whole
        ended = run(self._case.command, self._work, moment, whole, forked=self._case.forked)
        return before, ended, kill_judges.files(self._work)

    def _of_the_end(self, ended: Ended) -> Iterator[str]:
        if ended.left:
            yield f'{len(ended.left)} processes went on'
        if 'Traceback' in ended.told:
            yield f'traceback: {ended.told[-2000:]}'

    def _of_what_was_there(self, before: Files, found: Files) -> Iterator[str]:
        for name, content in before.items():
            new = self._results.get(name)
            if found.get(name) not in {content, new}:
                yield f'{name} was there, and is {"changed" if name in found else "gone"}'
        if kill_judges.files(self._sources) != self._kept:
            yield 'a source has changed'

    def _of_results(self, before: Files, ended: Ended, found: Files) -> Iterator[str]:
        shown = kill_judges.shown(found)
        for name, content in shown.items():
            if content != self._results.get(name, before.get(name)) and before.get(name) != content:
                yield f'{name} is half: {len(content)} bytes'
        for group in self._case.together:
            of = {n for n in self._results if n.startswith(f'{group}/')}
            missing = of - shown.keys()
            if missing and of & shown.keys():
                yield f'{group} is there without {sorted(missing)}'
        missing = self._results.keys() - shown.keys()
        if ended.status == self._case.status == 0 and missing:
            yield f'status {ended.status}, and {sorted(missing)} missing'

    def _of_the_bag(self, moment: Moment, ended: Ended) -> Iterator[str]:
        path = self._work / self._case.bag
        if not path.exists():
            return
        saved = self._work.with_name('saved')
        shutil.rmtree(saved, ignore_errors=True)
        yield from kill_judges.bag(path, saved / 'bag')
        torn = kill_judges.torn(path)
        if torn and ended.status >= 0 and moment.way != FULL:
            yield f'ended with {ended.status} by {moment.way}, and left a torn bag: {torn}'

    def _of_a_rerun(self, before: Files, found: Files) -> Iterator[str]:
        case = self._case
        if not case.again and not (self._work / case.bag).exists():
            return
        again = run(case.command, self._work, None, self._whole, forked=case.forked)
        after = kill_judges.files(self._work)
        if not case.again:
            if again.status != 1 or 'choose' not in again.told or after != found:
                yield f'again: status {again.status}, it should refuse: {again.told}'
            yield from self._of_debts()
            return
        there = all(found.get(n) == c for n, c in self._results.items())  # all but the last word
        if again.status != case.status and not (there and 'File exists' in again.told):
            yield f'again: status {again.status}: {again.told[-2000:]}'
        if case.bag:
            if torn := kill_judges.torn(self._work / case.bag):
                yield f'again: a torn bag: {torn}'
        elif kill_judges.shown(after) != before | kill_judges.shown(self._results):
            yield 'again: other results than undisturbed'
        if case.indexed and kill_judges.index(self._work) != self._index:
            yield 'again: the index tells something else than undisturbed'
        expected = {*before, *self._results, kill_judges.INDEX}
        litter = [n for n in after if n not in expected and n not in kill_judges.shown(after)]
        if litter:
            yield f'again: left behind {litter}'

    def _of_debts(self) -> Iterator[str]:
        """Events are whole wherever their recorder was ended, and the next one saves the others."""
        if not self._case.debts:
            return
        folder = self._work / 'events'
        torn = [path.name for path in kill_judges.events(folder) if kill_judges.torn(path)]
        if torn:
            yield f'torn events: {torn}'
        paid = run(self._case.debts, self._work, None, self._whole, forked=False)
        if paid.status or 'Traceback' in paid.told:
            yield f'the next recorder: status {paid.status}: {paid.told[-2000:]}'
        if left := kill_judges.unpaid(folder):
            yield f'the next recorder has left {left}'


def trials(case: Case, asked: argparse.Namespace, folder: Path) -> int:
    """End a command at as many moments as asked; print a row, return the number of faults."""
    with beside(case):
        trial, wrong, ways = Trial(case, folder, folder / 'sources'), 0, Counter()
        numbers = range(asked.first, asked.first + asked.moments)
        for number in track(numbers, f'{case.name:<24}', disable=not sys.stdout.isatty()):
            rng = random.Random(f'{asked.seed} {case.name} {number}')  # noqa: S311
            moment = trial.moment(rng, asked.by)
            ways[moment.way] += 1
            faults = list(trial.faults(moment))
            for fault in faults:
                print(f'{case.name} {number}: {moment}: {fault}', flush=True)
            wrong += bool(faults)
    told = ', '.join(f'{count} {way}' for way, count in sorted(ways.items()))
    print(f'{case.name:<24} {asked.moments:5} ended ({told}): {wrong} wrong', flush=True)
    return wrong


def main(words: list[str] | None = None) -> int:
    """End all, and return the status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--moments', type=int, default=100, help='at which each is ended')
    parser.add_argument('--seed', type=int, default=1, help='of the moments')
    parser.add_argument('--first', type=int, default=0, help='number of the first moment')
    parser.add_argument('--by', default='', help='change, names, written or clock; else all')
    parser.add_argument('--only', nargs='*', default=[], help='names of commands')
    parser.add_argument('--keep', action='store_true', help='keep the folder')
    asked = parser.parse_args(words)
    interrupt()  # so that what runs beside ends with this
    folder, wrong = Path(tempfile.mkdtemp(prefix='trial_kills_')), 0
    os.environ['XDG_CACHE_HOME'] = str(folder / 'cache')  # where an index goes from a full disk
    chosen = [case for case in cases(folder / 'sources', 'later') if _is_asked(case, asked.only)]
    prepare(folder / 'sources', chosen)
    with ExitStack() as stack:
        if any(case.beside == 'cluster' for case in chosen):
            address = stack.enter_context(cluster(folder))
            chosen = [c for c in cases(folder / 'sources', address) if _is_asked(c, asked.only)]
        for case in chosen:
            wrong += trials(case, asked, folder)
    if wrong or asked.keep:
        print(f'kept: {folder}')
    else:
        shutil.rmtree(folder)
    return int(wrong > 0)


def _is_asked(case: Case, names: list[str]) -> bool:
    return not names or case.name in names


if __name__ == '__main__':
    sys.exit(main())
