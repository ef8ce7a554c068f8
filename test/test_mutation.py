"""Changes of the code are noticed by the tests; launch_scripts/mutation is the long form."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
import mutation
from mutants import mutated, sites

SOURCE = '''
"""A text."""
from __future__ import annotations

LIMIT: Annotated[float, Spec('text', 'm', (0.0, 1.0))] = 2.0

def f(a: float = 1e-9) -> list[int]:
    """Return 1 + 1."""
    if a < 0.0:
        raise ValueError(f'a = {a + 1}')
    return not a and min(-a, a * 3)
'''


def test_every_kind_of_change_is_found_and_made():
    made = {
        f'{site.line}: {site.what}': ast.unparse(mutated(SOURCE, site)).splitlines()
        for site in sites(SOURCE)
    }
    assert list(made) == [
        '5: 2.0 -> 4.0',
        '9: Lt -> GtE',
        '9: 0.0 -> 1.0',
        '11: and -> or',
        '11: not dropped',
        '11: min -> max',
        '11: sign dropped',
        '11: Mult -> Div',
        '11: 3 -> 4',
    ]
    assert made['9: Lt -> GtE'][-3].strip() == 'if a >= 0.0:'
    last = [lines[-1].strip() for lines in made.values()]
    assert last[3:] == [
        'return not a or min(-a, a * 3)',
        'return not not a and min(-a, a * 3)',
        'return not a and max(-a, a * 3)',
        'return not a and min(+a, a * 3)',
        'return not a and min(-a, a / 3)',
        'return not a and min(-a, a * 4)',
    ]


def changes(source):
    return [site.what for site in sites(source)]


def test_what_is_a_matter_of_size_alone_is_no_behaviour():
    assert changes('PIECE, ANY = 1 << 20, 2**64') == []
    assert changes('CELLS = 2**few') == ['Pow -> Mult', '2 -> 3']
    assert changes('MOST = 500_000') == ['500000 -> 1000000']
    assert changes('FEW = 999') == ['999 -> 1000']


def test_half_a_turn_more_is_not_taken_for_half_a_turn_less():
    """It is the same direction, which no test can notice."""
    assert changes('turn = angle + pi') == ['Add -> Mult']
    assert changes('turn -= math.tau') == ['Sub -> Mult']
    assert changes('turn = angle + pit') == ['Add -> Sub']
    (site,) = sites('turn -= math.tau')
    assert ast.unparse(mutated('turn -= math.tau', site)) == 'turn *= math.tau'


def test_code_written_elsewhere_draws_no_other_changes(tmp_path, monkeypatch):
    """Who has mended what survived asks the same again; alike lines are told apart."""
    for name, before in (('first', ''), ('second', '"""More."""\n\n\n')):
        folder = tmp_path / name
        folder.mkdir()
        (folder / 'a.py').write_text(f'{before}x = 1 + 2\ny = 3 * 4\nz = 5 - 6\nz = 5 - 6\n')
    drawn = []
    for folder in ('first', 'second'):
        monkeypatch.setattr(mutation, 'ROOT', tmp_path / folder)
        drawn.append(
            [
                [(m.site.what, m.site.source) for m in mutation.draw([mutation.ROOT], 5, seed)]
                for seed in (0, 0, 1)
            ]
        )
    assert drawn[0] == drawn[1]
    once, again, other = drawn[0]
    assert once == again != other
    assert len(once) == 5


def test_the_nearest_tests_are_asked_first_with_those_of_the_numbers_of_the_room():
    (mutant, *_) = mutation.draw([ROOT / 'agv_motion/bag/mcap/batches.py'], 1, 0)
    first, *others = mutant.tests()
    room = ROOT / 'test' / 'bag'
    assert first == [str(room / 'mcap' / 'test_batches.py'), str(room / 'test_numbers.py')]
    rest = [test for stage in others for test in stage]
    assert len({*first, *rest}) == len(first) + len(rest)
    assert {str(path) for path in room.rglob('test_*.py')} <= {*first, *rest}
    assert rest[-1] == str(ROOT / 'test' / 'test_readme.py')


ENDLESS = """
from threading import Event
from hypothesis import given, strategies
from agv_motion.planar import FARTHEST
@given(strategies.just(0))
def test_it(_):
    if FARTHEST > 1.5e7:
        Event().wait()
"""


def test_changes_are_noticed_by_tests_that_fail_and_by_no_others(tmp_path):
    """FARTHEST is doubled, which a weak test takes for right; changes of the planner are seen.

    A test that hangs notices too, though hypothesis would try again what is interrupted.
    """
    for name, check in (('weak', 'FARTHEST > 0.0'), ('sharp', 'FARTHEST == 1e7')):
        test = tmp_path / f'test_{name}.py'
        test.write_text(f'from agv_motion.planar import FARTHEST\ndef test_it(): assert {check}\n')
    (tmp_path / 'test_endless.py').write_text(ENDLESS)
    code = f"""
import os
import mutation
from mutation import *
os.chdir(ROOT)
def verdict(mutant, tests):
    return os.waitstatus_to_exitcode(os.waitpid(child(mutant, tests), 0)[1])
file = ROOT / 'agv_motion' / 'planar.py'
site = next(site for site in sites(file.read_text()) if 'FARTHEST' in site.source)
for name in ('weak', 'sharp'):
    print(verdict(Mutant(file, site), [[{str(tmp_path)!r} + f'/test_{{name}}.py']]))
mutation.PATIENCE = 1
print(verdict(Mutant(file, site), [[{str(tmp_path / 'test_endless.py')!r}]]))
mutation.PATIENCE = 120
judged = draw([ROOT / 'agv_motion/kinematics/steering/rolling.py'], 2, 0)
print(judge(judged, 1, 1))
"""
    environment = os.environ | {
        'PYTHONPATH': os.pathsep.join([str(ROOT / 'launch_scripts' / 'mutants'), str(ROOT)])
    }
    result = subprocess.run(  # noqa: S603 - our own interpreter
        [sys.executable, '-c', code],
        capture_output=True, text=True, check=False, timeout=200, env=environment,
    )  # fmt: skip
    assert result.stdout.splitlines() == [
        '0', '1', '1', '2 of 132 changes in 1 files, seed 0', '0'
    ], result.stdout + result.stderr  # fmt: skip
