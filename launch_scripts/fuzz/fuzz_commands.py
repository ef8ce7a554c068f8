"""Give every command that reads bags 200 and more of them that are damaged, odd or foreign.

launch_scripts/fuzz/fuzz_commands.py [SEED] [NAME ...]: all bags, or those in whose names one of the
words is. Of each it is known what was written into it. A command may end with status 0 only if it
tells and makes the same as of a sound bag with the same messages; of a bag with which nothing is
wrong it must end as there. Any other answer is an error that names the file and the place, in a
few seconds. Ends with status 1 where that does not hold; test/cli/test_commands.py is the short
form. The bags are in `odd_*.py`.
"""

from __future__ import annotations

import os
import random
import shutil
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

import odd_contents
import odd_databases
import odd_files
import odd_mcap
from command_answers import Answer, made, run, saved, written, wrong
from odd_bags import by_us
from typer import Context
from typer.main import get_command

from agv_motion.cli.main import app

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from odd_bags import Case, Maker, Sent

BAGS = {'bag', 'bags', 'damaged', 'first'}
"""Names of the arguments that are bags"""
DRIVING = 'differential_kinematics'
COMMAND = get_command(app)


def commands(bag: Path, twin: Path, topics: Sequence[str], to: Path) -> dict[str, list[str]]:
    """Return the words of every command that reads a bag; what they make is to lie in ``to``."""
    first = topics[0] if topics else '/a'
    words = {
        'bag info': [bag, '-v'], 'bag info names': [bag, '-t'], 'bag hz': [bag],
        'bag gaps': [bag, *topics[:3]], 'bag hz header': [bag, '--header'], 'bag check': [bag],
        **{f'bag echo {i}': [bag, t] for i, t in enumerate(topics[-3:])},
        'bag echo csv': [bag, first, '--csv', '--include-message-info'],
        'bag export': [bag, to / 'tables'], 'bag recover': [bag, to / 'saved'],
        'bag plot': [bag, f'{first}/data', '-o', to / 'a.png'], 'bag diff': [bag, twin],
        'bag diff to': [twin, bag], 'plot': [bag, '-o', to / 'run.png'],
        'calibrate': [bag, '-o', to / 'new.yaml', '--node', DRIVING],
        'replay': [bag, '-r', '1000', '--disable-keyboard-controls', '--playback-duration', '50'],
        'report': [bag, '-o', to / 'day.html'],
        'reprocess': [bag, to / 'again', '-n', DRIVING, '-c', 'differential.yaml'],
    }  # fmt: skip
    return {name: [*verb(name), *map(str, rest)] for name, rest in words.items()}


def verb(name: str) -> list[str]:
    """Return the words of a command from its name among the trials."""
    parts = name.split()
    return parts[: 2 if parts[0] == 'bag' else 1]


def readers(command: Any = COMMAND, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Yield the words of every command of `agv` that takes a bag."""
    if hasattr(command, 'list_commands'):
        context = Context(command)
        for name in command.list_commands(context):
            yield from readers(command.get_command(context, name), (*path, name))
    if any(parameter.name in BAGS for parameter in command.params):
        yield path


class Trial:
    """Runs the commands over bags, and beside each over a sound one with the same messages."""

    def __init__(self, folder: Path, without: Sequence[str] = ()) -> None:
        """Keep where to write, and which commands not to run."""
        self._folder, self._without = folder, without
        self._twins: dict[int, tuple[Path, dict[str, Answer]]] = {}
        self.answers = Counter[str]()
        """how often each status came"""

    def judge(self, name: str, make: Maker, seed: int) -> list[str]:
        """Return what does not hold of one bag."""
        folder = self._folder / 'case'
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        case = make(folder, random.Random(f'{seed} {name}'))  # noqa: S311
        try:
            return list(self._judged(case, folder))
        finally:
            case.close()

    def _judged(self, case: Case, folder: Path) -> Iterator[str]:
        sent = case.messages or ()
        twin, expected = self._twin(sent)
        to = folder / 'made by the command'
        topics = list(dict.fromkeys(one.topic.name for one in sent))
        for name, words in commands(case.path, twin, topics, to).items():
            if name in self._without:
                continue
            answer = self._answer(words, to)
            self.answers[f'status {answer.status}'] += 1
            for finding in wrong(name, case, answer, expected.get(name)):
                yield f'{name}: {finding}'

    def _answer(self, words: Sequence[str], to: Path) -> Answer:
        to.mkdir()
        try:
            answer = run(words)
            what = saved(to / 'saved') if 'recover' in words[:2] else made(to)
            return answer._replace(made=what)
        finally:
            shutil.rmtree(to)

    def _twin(self, sent: Sequence[Sent]) -> tuple[Path, dict[str, Answer]]:
        """Return a sound bag with these messages, and what the commands say of it."""
        key = hash(tuple(sent))
        if key not in self._twins:
            twin = self._folder / f'twin_{len(self._twins)}'
            ordered = sorted(sent, key=lambda one: one.stamp)
            by_us(twin, ordered, chunk_size=1 << 20, chunk_duration=1e9)
            assert saved(twin) == written(sent)
            topics = list(dict.fromkeys(one.topic.name for one in sent))
            to = self._folder / 'made of the twin'
            words = commands(twin, twin, topics, to)
            answers = {n: self._answer(w, to) for n, w in words.items() if n not in self._without}
            self._twins[key] = twin, answers
        return self._twins[key]


def cases() -> dict[str, Maker]:
    """Return all bags by name."""
    found = [*odd_mcap.cases(), *odd_contents.cases(), *odd_files.cases(), *odd_databases.cases()]
    assert len(dict(found)) == len(found), Counter(name for name, _ in found).most_common(3)
    return dict(found)


def main(words: list[str]) -> int:
    """Run all, print what does not hold, and return the status."""
    seed = int(words[0]) if words else 1
    begun, failed, tried = time.monotonic(), 0, 0
    with tempfile.TemporaryDirectory() as name:
        trial = Trial(Path(name))
        os.chdir(name)
        for which, make in cases().items():
            if words[1:] and not any(word in which for word in words[1:]):
                continue
            found = trial.judge(which, make, seed)
            tried, failed = tried + 1, failed + bool(found)
            for finding in found:
                print(f'{which}: {finding}', flush=True)
    print(f'{tried} bags, {failed} of which do not hold, {time.monotonic() - begun:.0f} s')
    print(', '.join(f'{count} times {what}' for what, count in trial.answers.most_common()))
    return int(failed > 0)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
