"""The frame of all demos: it asks the scenario, records, and leaves the graph whatever comes."""

from __future__ import annotations

import signal
from io import StringIO
from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

import rclpy
from rich.console import Console
from std_msgs.msg import String

from agv_motion.bag.reader import BagReader
from agv_motion.demo.frame import Demo, next_after
from agv_motion.demo.recorder import RecordedTopic
from agv_motion.demo.scenario import DemoGraph, Scenario
from agv_motion.errors import GeometryError


class Clockwork(Scenario[None]):
    """Time goes on by a second whenever somebody asks whether it is over."""

    figure = 'none.png'
    doing = 'counting'

    def __init__(self, seconds, *, impossible=False):
        super().__init__(seconds)
        self.impossible = impossible
        self.clock = SimpleNamespace(time=100.0, nanoseconds=100 * 10**9, elapsed=0.0)

    def build(self):
        if self.impossible:
            msg = 'it cannot be'
            raise GeometryError(msg)
        return DemoGraph((), SimpleNamespace(plain=self.clock), [RecordedTopic('word', String)])

    def over(self, elapsed, say):
        self.clock.elapsed += 1.0
        if elapsed == 2.0:
            say('two seconds')
        return super().over(elapsed, say)

    def read(self, bag):
        return None

    def tell(self, run, demo):
        yield from ()

    def draw(self, run, path):
        return False


@pytest.fixture(autouse=True)
def signals():
    """Give the signals back that a demo takes over."""
    before = {n: signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


def test_it_runs_until_the_scenario_is_over_and_leaves_a_bag(tmp_path):
    scenario, printed = Clockwork(5.0), StringIO()
    with Demo(scenario, tmp_path / 'bag') as demo:
        demo.run(Console(file=printed), live=False)
    assert not rclpy.ok()
    assert demo.elapsed == 6.0
    assert scenario.progress(2.0) == (0.4, 'counting')
    assert 'two seconds' in printed.getvalue()
    with BagReader(tmp_path / 'bag') as bag:
        assert list(bag.topics) == ['/word', '/mark']  # /mark: what a person notes


def test_a_scenario_that_cannot_be_built_leaves_no_graph(tmp_path):
    with (
        pytest.raises(GeometryError, match='it cannot be'),
        Demo(Clockwork(5.0, impossible=True), tmp_path / 'bag'),
    ):
        pass
    assert not rclpy.ok()
    assert not (tmp_path / 'bag').exists()


def test_the_speed_is_that_of_the_run_not_of_the_report_after_it(tmp_path):
    with Demo(Clockwork(5.0), tmp_path / 'bag') as demo:
        demo.run(Console(), live=False)
    first = demo.factor
    assert first > 0.0
    assert demo.factor == first


def test_a_slow_terminal_has_fewer_pictures():
    assert next_after(10.0, 10.01) == pytest.approx(10.25)
    assert next_after(10.0, 11.0) == pytest.approx(15.0)
