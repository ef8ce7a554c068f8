"""The README is true: every parameter stands in it, with its default, range and meaning."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from agv_motion.cli.nodes import available
from agv_motion.cli.parameters import describe, parameters_of

README = (Path(__file__).parents[1] / 'README.md').read_text(encoding='utf-8')


@pytest.mark.parametrize('node', available())
def test_every_parameter_of_every_node(node):
    section = README.split(f'### {node}\n')[1].split('\n### ')[0]
    for row in describe(parameters_of(node)):
        assert f'| `{row.name}` | `{row.default}` | {row.allowed} | {row.meaning} |' in section
