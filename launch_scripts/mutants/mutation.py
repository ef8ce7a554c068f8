"""Mutation testing: one seeded change at a time in the core; the tests must notice each.

    python launch_scripts/mutants/mutation.py                                   # 100 over the core
    python launch_scripts/mutants/mutation.py agv_motion/kinematics/steering --count 20

A change is a sign, an operator, a comparison, a condition or a number. No file is touched: the
changed module is compiled as it is imported, in a process of its own, so that a run can be stopped
at any time. Asked are the test file that mirrors the module, then its folder, then its room. Exits
with 1 when more than `--most` survive.

Why not mutmut or cosmic-ray: they write the changes into a tree and start Python anew for each,
which here takes several times as long, and neither draws a seeded sample of a given size.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import time
from functools import cache
from hashlib import sha256
from importlib.machinery import SourceFileLoader
from importlib.util import spec_from_loader
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from hypothesis import Phase, settings
from mutants import Site, mutated, sites
from rich.console import Console
from rich.progress import Progress

ROOT = Path(__file__).parents[2]
CORE = (
    'planar.py', 'probe', 'motion', 'kinematics', 'odometry', 'trajectory', 'route', 'sequence',
    'simulation', 'bag',
)  # fmt: skip
SURVIVED, KILLED, BROKEN = 0, 1, 2
PATIENCE = 120
"""[s] A test that takes longer hangs, which is noticed too."""


class Mutant(NamedTuple):
    """One change of one file."""

    path: Path
    site: Site

    @property
    def module(self) -> str:
        """Its name, as it is imported."""
        parts = self.path.relative_to(ROOT).with_suffix('').parts
        return '.'.join(parts[:-1] if parts[-1] == '__init__' else parts)

    def tests(self) -> list[list[str]]:
        """Return the tests to ask, the nearest first, each once.

        The file that mirrors the module, with that of its room for numbers; those of the core that
        name it, those beside it, its room, and last the one that holds the defaults of parameters
        to their tables.
        """
        inside = self.path.relative_to(ROOT / 'agv_motion')
        folder, room = ROOT / 'test' / inside.parent, ROOT / 'test' / inside.parts[0]
        near = [folder / f'test_{inside.name}', folder / 'test_golden.py', room / 'test_numbers.py']
        beside = sorted(folder.glob('test_*.py'))
        name = re.compile(rf'{re.escape(self.module)}\b')
        named = [path for path, text in texts().items() if name.search(text)]
        asked: set[Path] = set()
        stages = []
        tables = [ROOT / 'test' / 'test_readme.py']
        for paths in (near, named, beside, sorted(room.rglob('test_*.py')), tables):
            stages.append([str(path) for path in paths if path.exists() and path not in asked])
            asked.update(paths)
        return [stage for stage in stages if stage]


@cache
def texts() -> dict[Path, str]:
    """Return what the tests of the core say, by file."""
    rooms = (ROOT / 'test' / name for name in CORE)
    return {path: path.read_text() for room in rooms for path in sorted(room.rglob('test_*.py'))}


class Loader(SourceFileLoader):
    """Loads one module with its change."""

    def __init__(self, mutant: Mutant) -> None:
        """Change the code of ``mutant``."""
        super().__init__(mutant.module, str(mutant.path))
        self._code = compile(mutated(mutant.path.read_text(), mutant.site), mutant.path, 'exec')

    def get_code(self, fullname: str) -> Any:
        """Return the changed code."""
        return self._code if fullname == self.name else super().get_code(fullname)


class Finder:
    """Finds one module with its change."""

    def __init__(self, mutant: Mutant) -> None:
        """Look for ``mutant`` alone."""
        self._mutant = mutant

    def find_spec(self, name: str, _path: Any = None, _target: Any = None) -> Any:
        """Return how to load it."""
        if name != self._mutant.module:
            return None
        package = self._mutant.path.name == '__init__.py'
        return spec_from_loader(name, Loader(self._mutant), is_package=package)


class Hurry:
    """A plugin of pytest: a failure is enough, nobody wants the smallest example."""

    def pytest_sessionstart(self) -> None:
        """Change the profile that conftest.py has loaded."""
        phases = (Phase.explicit, Phase.generate)
        settings.register_profile('mutation', settings(), phases=phases)
        settings.load_profile('mutation')


def ask(mutant: Mutant | None, tests: list[str]) -> int:
    """Run ``tests`` with the change in this process; return what pytest returns."""
    if mutant is not None:
        sys.meta_path.insert(0, Finder(mutant))
    given = ['-q', '-x', '-p', 'no:cacheprovider', '-p', 'no:xdist', f'--timeout={PATIENCE}']
    # by a thread, which ends the process: hypothesis would try again what a signal interrupts
    given.append('--timeout-method=thread')
    early = ['-W', 'ignore::pytest.PytestAssertRewriteWarning']  # hypothesis is here already
    return int(pytest.main([*given, *early, *tests], plugins=[Hurry()]))


def verdict_of(mutant: Mutant | None, stages: list[list[str]]) -> int:
    """Return whether a test of some stage notices the change."""
    for tests in stages:
        if ask(mutant, tests) not in {pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED}:
            return KILLED
    return SURVIVED


def child(mutant: Mutant | None, stages: list[list[str]]) -> int:
    """Start a process that asks the tests, stage by stage; return its number."""
    pid = os.fork()
    if pid:
        return pid
    verdict = BROKEN
    try:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        verdict = verdict_of(mutant, stages)
    finally:
        os._exit(verdict)


def draw(paths: list[Path], count: int, seed: int) -> list[Mutant]:
    """Return a seeded sample of all changes of the files in ``paths``.

    A change has its lot of its own, so that code written elsewhere does not draw others: who has
    mended what survived asks the same again.
    """
    files = [
        file for path in paths for file in (sorted(path.rglob('*.py')) if path.is_dir() else [path])
    ]
    every: dict[str, Mutant] = {}
    for mutant in (Mutant(file, site) for file in files for site in sites(file.read_text())):
        key = ' '.join((str(seed), mutant.module, mutant.site.what, mutant.site.source))
        while key in every:  # twice in one line, or in two that are alike
            key += ' again'
        every[key] = mutant
    chosen = [every[key] for key in sorted(every, key=_lot)[:count]]
    print(f'{len(chosen)} of {len(every)} changes in {len(files)} files, seed {seed}')
    return chosen


def _lot(key: str) -> bytes:
    return sha256(key.encode()).digest()


def judge(mutants: list[Mutant], jobs: int, stages: int | None) -> int:
    """Return how many changes no test of the first ``stages`` notices; print each at once."""
    left, running, survivors = list(reversed(mutants)), {}, 0
    with Progress(console=Console(stderr=True), disable=not sys.stderr.isatty()) as progress:
        bar = progress.add_task('Mutants', total=len(mutants))
        while left or running:
            while left and len(running) < jobs:
                mutant = left.pop()
                running[child(mutant, mutant.tests()[:stages])] = mutant
            pid, status = os.wait()
            if (asked := running.pop(pid, None)) is None:
                continue
            progress.advance(bar)
            verdict = os.waitstatus_to_exitcode(status)
            if verdict == BROKEN:
                sys.exit(f'could not ask the tests of {asked}: run it alone')
            if verdict == SURVIVED:
                survivors += 1
                where = f'{asked.path.relative_to(ROOT)}:{asked.site.line}'
                print(
                    f'nobody notices {where}  {asked.site.what}  in  {asked.site.source}',
                    flush=True,
                )
    return survivors


def pass_as_they_are(mutants: list[Mutant], stages: int | None) -> bool:
    """Return whether all tests that are asked pass where nothing is changed."""
    every = {test for each in mutants for tests in each.tests()[:stages] for test in tests}
    _, status = os.waitpid(child(None, [sorted(every)]), 0)
    return os.waitstatus_to_exitcode(status) == SURVIVED


def main() -> None:
    """Draw, break, ask, and print what nobody noticed."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('paths', nargs='*', type=Path, help='files or folders; default: the core')
    parser.add_argument('--count', type=int, default=100)
    parser.add_argument('--seed', type=int, default=0)
    parser.add_argument('--most', type=int, default=0, help='survivors that are accepted')
    parser.add_argument('--jobs', type=int, default=os.cpu_count() or 1, help='processes at a time')
    parser.add_argument('--near', action='store_true', help='ask only the nearest test files')
    parser.add_argument('--trust', action='store_true', help='do not run the tests unchanged first')
    given = parser.parse_args()
    sys.path.insert(0, str(ROOT))
    os.chdir(ROOT)
    paths = [path.resolve() for path in given.paths]
    mutants = draw(paths or [ROOT / 'agv_motion' / name for name in CORE], given.count, given.seed)
    if not mutants and given.count:
        sys.exit(f'nothing to change in {given.paths}: give files or folders of agv_motion')
    stages = 1 if given.near else None
    if not given.trust and not pass_as_they_are(mutants, stages):
        sys.exit('the tests fail as they are: launch_scripts/test says which')
    begin = time.monotonic()
    survivors = judge(mutants, given.jobs, stages)
    print(f'{survivors} of {len(mutants)} survived, {time.monotonic() - begin:.0f} s')
    sys.exit(survivors > given.most)


if __name__ == '__main__':
    main()
