"""The page of the nodes is true: every parameter stands in it, with its default and meaning."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from agv_motion.nodes.catalogue import available

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / 'launch_scripts'))

from node_tables import PAGE, written


def test_the_tables_of_the_nodes_are_as_their_parameters_are_declared():
    page = PAGE.read_text(encoding='utf-8')
    told, meant = page.splitlines(), written(page).splitlines()
    wrong = [line for line in meant if line not in told]
    assert told == meant, f'run python launch_scripts/node_tables.py, for {wrong[:3]}'


def test_a_node_without_a_section_is_named():
    page = PAGE.read_text(encoding='utf-8')
    with pytest.raises(ValueError, match='no section "## simulator"'):
        written(page.replace('\n## simulator\n', '\n## another\n'))


def test_the_readme_names_every_node():
    readme = (ROOT / 'README.md').read_text(encoding='utf-8')
    assert [node for node in available() if f'`{node}`' not in readme] == []
