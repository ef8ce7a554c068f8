"""`agv selftest`: right values pass, and any wrong one is told."""

from __future__ import annotations

from math import nan, nextafter

import pytest
from typer.testing import CliRunner

from agv_motion.cli import selftest
from agv_motion.cli.main import app
from agv_motion.cli.selftest import Comparison


def test_all_values_agree_with_those_by_hand():
    result = CliRunner().invoke(app, ['selftest'], env={'COLUMNS': '200'})
    assert result.exit_code == 0
    assert 'values as computed by hand' in result.output
    assert result.output.count('ok ') == sum(len(list(room())) for room in selftest.ROOMS) >= 14


@pytest.mark.parametrize('computed', [1.0 + 1e-9, -1.0, nan])
def test_a_value_that_differs_is_told_and_ends_with_1(monkeypatch, computed):
    def _kinematics():
        yield Comparison('one', computed, 1.0)

    monkeypatch.setattr(selftest, 'ROOMS', (_kinematics,))
    result = CliRunner().invoke(app, ['selftest'])
    assert result.exit_code == 1
    assert '1 of 1 values differ' in result.stderr
    assert 'differs' in result.stdout


def test_rounding_is_no_difference():
    assert Comparison('one', nextafter(1.0, 2.0), 1.0).holds
