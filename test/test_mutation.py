"""Changes of the code are noticed by the tests; launch_scripts/mutation is the long form."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[1] / 'launch_scripts'
sys.path.insert(0, str(FOLDER))
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


def run(*arguments):
    return subprocess.run(  # noqa: S603 - our own interpreter
        [sys.executable, *arguments], capture_output=True, text=True, check=False, timeout=200
    )


def test_changes_of_the_steering_planner_are_noticed():
    file = 'agv_motion/kinematics/steering/rolling.py'
    how = ('--count', '3', '--seed', '4', '--trust', '--jobs', '1')
    result = run(str(FOLDER / 'mutation.py'), file, *how)
    assert result.stdout.splitlines()[-1].startswith('0 of 3 survived'), result.stdout
    assert result.returncode == 0


@pytest.mark.parametrize(
    ('check', 'verdict'), [('FARTHEST > 0.0', 'SURVIVED'), ('FARTHEST == 1e7', 'KILLED')]
)
def test_a_change_is_noticed_by_a_test_that_fails(tmp_path, check, verdict):
    """FARTHEST is doubled, which a weak test takes for right."""
    test = tmp_path / 'test_farthest.py'
    test.write_text(f'from agv_motion.planar import FARTHEST\ndef test_it(): assert {check}\n')
    code = (
        f'import os, sys; sys.path.insert(0, {str(FOLDER)!r})\n'
        'from mutation import *\n'
        'file = ROOT / "agv_motion" / "planar.py"\n'
        'site = next(site for site in sites(file.read_text()) if "FARTHEST" in site.source)\n'
        f'pid = child(Mutant(file, site), [[{str(test)!r}]])\n'
        f'assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == {verdict}\n'
    )
    result = run('-c', code)
    assert result.returncode == 0, result.stderr
