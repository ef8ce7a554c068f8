"""Every strategy in the table can be chosen, and the documents tell of it."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from agv_motion.errors import ConfigurationError
from agv_motion.motion.behavior.goals.strategies import STRATEGIES, GoalParameters

ROOT = Path(__file__).parents[4]
EVERY = pytest.mark.parametrize('name', STRATEGIES)


@EVERY
def test_each_is_told_on_the_page_of_the_nodes_and_can_be_chosen(name):
    told = (ROOT / 'agv_motion' / 'nodes' / 'README.md').read_text()
    row = next(line for line in told.splitlines() if line.startswith('| `goals.strategy`'))
    missing = f"tell of strategy '{name}': run python launch_scripts/node_tables.py"
    assert f'{name}: {STRATEGIES[name].text}' in row, missing
    assert GoalParameters(strategy=name).kind is STRATEGIES[name]


@EVERY
def test_each_has_a_comment_where_a_user_chooses_it(name):
    config = (ROOT / 'config' / 'tree.yaml').read_text()
    assert yaml.safe_load(config)
    assert name in config.split('strategy:')[0].rsplit('goals:', 1)[-1], (
        f"tell of strategy '{name}' above goals.strategy in config/tree.yaml"
    )


def test_another_name_is_refused():
    with pytest.raises(ConfigurationError, match=f'choose one of {", ".join(STRATEGIES)}'):
        GoalParameters(strategy='best')
