"""Every strategy in the table can be chosen, and the documents tell of it."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest
import yaml

from agv_motion.errors import ConfigurationError
from agv_motion.motion.behavior import goals
from agv_motion.motion.behavior.goals.strategies import STRATEGIES, GoalParameters
from agv_motion.motion.behavior.goals.strategy import GoalSetting, GoalStrategy
from agv_motion.motion.navigation.open_floor import OpenFloor
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone

ROOT = Path(__file__).parents[4]
SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
EVERY = pytest.mark.parametrize('name', STRATEGIES)


@EVERY
def test_each_is_told_on_the_page_of_the_nodes_and_can_be_chosen(name):
    told = (ROOT / 'agv_motion' / 'nodes' / 'README.md').read_text()
    row = next(line for line in told.splitlines() if line.startswith('| `goals.strategy`'))
    missing = f"tell of strategy '{name}': run python launch_scripts/generate/node_tables.py"
    assert f'{name}: {STRATEGIES[name].text}' in row, missing
    assert GoalParameters(strategy=name).kind is STRATEGIES[name]


@EVERY
def test_each_has_a_comment_where_a_user_chooses_it(name):
    config = (ROOT / 'config' / 'tree.yaml').read_text()
    assert yaml.safe_load(config)
    assert f'{name}: ' in config.split('strategy:')[0].rsplit('goals:', 1)[-1], (
        f"tell of strategy '{name}' above goals.strategy in config/tree.yaml"
    )


def test_another_name_is_refused():
    with pytest.raises(ConfigurationError, match=f'choose one of {", ".join(STRATEGIES)}'):
        GoalParameters(strategy='best')


def test_each_file_with_a_strategy_has_a_row_in_the_table():
    setting = GoalSetting(
        (1.0, 1.0), 1, 9, OpenFloor(PathPlanner(Zone(SQUARE))), lambda _objective: 1.0
    )
    known = {type(kind.build(setting)) for kind in STRATEGIES.values()} | {GoalStrategy}
    for path in (ROOT / 'agv_motion/motion/behavior/goals').glob('*.py'):
        module = importlib.import_module(f'{goals.__name__}.{path.stem}')
        for name, kind in vars(module).items():
            if isinstance(kind, type) and hasattr(kind, 'next_goal'):
                assert kind in known, f'give {name} of {path.name} a row in STRATEGIES'
