"""The table of tracking laws: whoever adds one and forgets a step is told which."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from agv_motion.parameters import nested
from agv_motion.trajectory import FollowerParameters
from agv_motion.trajectory.follower_parameters import LAWS

ROOT = Path(__file__).parents[2]


def test_every_law_stands_in_the_table():
    table = (ROOT / 'agv_motion' / 'trajectory' / 'follower_parameters.py').read_text()
    for path in sorted((ROOT / 'agv_motion' / 'trajectory').glob('*.py')):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ClassDef) and not node.name.endswith('Law'):
                methods = {each.name for each in node.body if isinstance(each, ast.FunctionDef)}
                if {'twist', 'lyapunov'} <= methods:
                    assert f': {node.name},' in table, (
                        f'add {node.name} to LAWS in trajectory/follower_parameters.py'
                    )


@pytest.mark.parametrize('name', LAWS)
def test_every_law_has_gains_of_its_name_and_says_whether_it_goes_sideways(name):
    groups = dict(nested(FollowerParameters))
    assert name in groups, f'add a field {name} to FollowerParameters'
    law = FollowerParameters(law=name).make_law()
    assert isinstance(law.goes_sideways, bool)
    assert isinstance(law.gains, groups[name])


@pytest.mark.parametrize('name', LAWS)
def test_every_law_is_told_to_users(name):
    page = (ROOT / 'agv_motion' / 'nodes' / 'README.md').read_text()
    assert f'| `follow.{name}.' in page, f'run launch_scripts/generate/node_tables.py for {name}'
    words = (ROOT / 'config' / 'differential.yaml').read_text()
    assert f'      {name}:' in words, f'add the gains of {name} to config/differential.yaml'
