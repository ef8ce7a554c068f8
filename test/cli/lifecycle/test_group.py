"""`agv lifecycle` says what `ros2 lifecycle` says."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')


def test_nodes_and_states(alone, oak):
    assert oak in alone('lifecycle', 'nodes')[1].splitlines()
    assert f'{oak}: active [3]' in alone('lifecycle', 'get')[1].splitlines()


def test_a_node_changes_its_state_and_back(alone, oak):
    assert alone('lifecycle', 'set', oak, 'deactivate') == (0, 'Transitioning successful\n', '')
    try:
        assert alone('lifecycle', 'get', oak)[1] == 'inactive [2]\n'
        offered = alone('lifecycle', 'list', oak)[1]
        assert offered.startswith('- cleanup [2]\n\tStart: inactive\n\tGoal: cleaningup\n')
    finally:
        assert alone('lifecycle', 'set', oak, '3')[1] == 'Transitioning successful\n'


def test_mistakes(alone, oak):
    status, _, errors = alone('lifecycle', 'set', oak, 'deactivat')
    assert status == 1
    assert errors.startswith(
        'error: Unknown transition requested, available ones are:\n    - deactivate [4]\n'
    )
    assert "did you mean 'deactivate'?" in errors
    status, _, errors = alone('lifecycle', 'get', oak[:-1])
    assert (status, errors) == (1, f"error: Node not found: '{oak[:-1]}'; did you mean '{oak}'?\n")
