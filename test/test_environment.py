"""What the scripts install their environment by: uv where it is, else pip; told once, kept."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

PYTHON = """#!/bin/sh
# stands for Python: makes environments of itself, and tells what else is asked of it
case "$*" in
    '-c '* | --version) ;;
    *'-m venv'*)
        for place; do :; done
        mkdir -p "$place/bin" && cp "$0" "$place/bin/python";;
    *) echo "$(basename "$0") $*" >>"$ASKED"
       case "$*" in *"$FAILS"*) exit 1;; esac;;
esac
"""

UV = """#!/bin/sh
echo "uv $*" >>"$ASKED"
exit "$UV_ENDS"
"""


@pytest.fixture
def install(tmp_path):
    """Make an environment by stand-ins, and return how that ended and what they were asked."""
    programs = tmp_path / 'bin'
    programs.mkdir()

    def run(fails: str = 'nothing', uv_ends: int | None = None) -> tuple[int, list[str]]:
        stand_ins = {'python3.13': PYTHON} | ({} if uv_ends is None else {'uv': UV})
        for name, text in stand_ins.items():
            (programs / name).write_text(text)
            (programs / name).chmod(0o755)
        asked = tmp_path / 'asked'
        asked.write_text('')
        environment = {
            'PATH': f'{programs}:/usr/bin:/bin', 'ASKED': str(asked), 'FAILS': fails,
            'UV_ENDS': str(uv_ends), 'AGV_MOTION_VENV': str(tmp_path / 'venv'),
        }  # fmt: skip
        ended = subprocess.run(
            ['/bin/sh', '-c', 'cd launch_scripts; . ./environment.sh; use_environment ros', 'demo'],
            cwd=ROOT, env=environment, capture_output=True, check=False,
        ).returncode  # fmt: skip
        return ended, asked.read_text().splitlines()

    return run


def test_an_environment_is_installed_by_the_pip_of_the_base_once(install):
    ended, asked = install()
    assert ended == 0
    first, second = asked
    assert first.startswith('python3.13 -m pip --python')
    assert first.endswith('pip setuptools')
    assert second.startswith('python -m pip install')
    assert second.endswith(f'{ROOT}[ros]')
    assert '--no-build-isolation' in second
    assert install() == (0, [])  # all is there


def test_a_base_whose_pip_is_missing_or_old_gives_the_one_it_brings_and_that_is_renewed(install):
    ended, asked = install(fails='--python')
    assert ended == 0
    assert [line.split()[:3] for line in asked[1:]] == [
        ['python', '-m', 'ensurepip'],
        ['python', '-m', 'pip'],
        ['python', '-m', 'pip'],
    ]
    assert '--upgrade' in asked[2]  # its setuptools may be too old to build wheels


def test_uv_is_enough_where_it_is(install):
    ended, (asked,) = install(uv_ends=0)
    assert ended == 0
    assert asked.startswith('uv pip install')
    assert asked.endswith(f'pip setuptools {ROOT}[ros]')


def test_where_uv_cannot_pip_does_it(install):
    ended, asked = install(uv_ends=2)
    assert ended == 0
    assert [line.split()[0] for line in asked] == ['uv', 'python3.13', 'python']


def test_what_failed_is_tried_again(install):
    assert install(fails=f'{ROOT}[ros]')[0] != 0
    ended, asked = install()
    assert ended == 0
    assert len(asked) == 1  # pip is there already
