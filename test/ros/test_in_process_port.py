"""The port of a node without middleware: names, time, timers, services, complaints."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PointStamped
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from agv_motion.errors import SignalError
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_port import InProcessPort, Place, full_name
from agv_motion.ros.qos import COMMAND

SECOND = 1_000_000_000


class Stage:
    """A graph that keeps what is said, and a port in it."""

    def __init__(self, namespace='/oak', remap=None):
        self.said = []
        self.graph = InProcessGraph(lambda *told: self.said.append(told), 5 * SECOND)
        place = Place('node', namespace, remap or {})
        self.port = InProcessPort(self.graph, place, lambda error: f'<{error}>')
        self.port.active = True


@pytest.mark.parametrize(
    ('topic', 'namespace', 'full'),
    [
        ('fix', '/', '/fix'), ('fix', '/oak', '/oak/fix'), ('/fix', '/oak', '/fix'),
        ('a/b', '/oak/', '/oak/a/b'),
    ],
)  # fmt: skip
def test_full_names(topic, namespace, full):
    assert full_name(topic, namespace) == full


def test_private_names_and_remaps():
    port = Stage(remap={'/oak/node/state': '/state', '/oak/fix': '/elm/fix'}).port
    assert port.full_name('~/tick') == '/oak/node/tick'
    assert port.full_name('~/state') == '/state'
    assert port.full_name('fix') == '/elm/fix'
    assert (port.name, port.namespace) == ('node', '/oak')


def test_time_is_that_of_the_graph():
    stage = Stage()
    port, stage.graph.now = stage.port, 7 * SECOND + 12
    message = PointStamped()
    assert port.stamp(message) == pytest.approx(7.000000012)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (7, 12)
    assert port.nanoseconds() == 7 * SECOND + 12
    assert port.seconds() == port.steady_seconds() == pytest.approx(7.000000012)


def test_timers_act_while_active_and_what_they_refuse_is_counted():
    stage, ticks = Stage(), []

    def tick():
        ticks.append(stage.graph.now)
        if len(ticks) == 2:
            msg = 'no more'
            raise SignalError(msg)

    stage.port.every(0.5, tick)
    stage.graph.run(6 * SECOND)
    stage.port.active = False
    stage.graph.run(7 * SECOND)
    assert ticks == [5 * SECOND + SECOND // 2, 6 * SECOND]
    assert stage.graph.complaints == {'node: refused: <no more>': 1}


def test_inputs_are_looked_at_several_times_before_they_are_lost():
    stage, looks = Stage(), []
    stage.port.watch_inputs(0.2, lambda: looks.append(stage.graph.now))
    stage.port.watch_inputs(10.0, lambda: looks.append(-1))
    stage.graph.run(5 * SECOND + SECOND // 5)
    assert [look for look in looks if look > 0] == [
        5 * SECOND + k * SECOND // 20 for k in (1, 2, 3, 4)
    ]
    assert looks.count(-1) == 2  # ten times a second at least


def test_publishers_are_counted_by_full_name():
    port = Stage().port
    assert port.count_publishers('fix') == 0
    port.publisher(Float64, '/oak/fix', COMMAND)
    assert port.count_publishers('fix') == 1


def test_only_warnings_and_errors_are_kept():
    stage = Stage()
    stage.port.info('hello')
    stage.port.warning('late', throttle_duration_sec=1.0)
    stage.port.error('lost')
    stage.port.refuse('x' * 10_000)
    assert list(stage.graph.complaints)[:2] == ['node: late', 'node: lost']
    assert len(max(stage.graph.complaints, key=len)) < 2000


def test_services_are_there_to_be_asked_by_a_test():
    port = Stage().port
    port.serve(Trigger, '~/stop', lambda _: 'stopped')
    kind, act = port.services['~/stop']
    assert (kind, act(None)) == (Trigger, 'stopped')


def test_a_recording_is_known_by_its_topics():
    stage = Stage()
    assert not stage.port.is_recorded
    stage.graph.recorded = {'/oak/fix'}
    assert stage.port.is_recorded
    assert not stage.port.is_simulated


def test_an_inactive_node_hears_nothing_and_a_wrong_message_is_told_with_its_topic():
    stage, heard = Stage(), []

    def hear(message):
        if message.data < 0.0:
            msg = 'negative'
            raise SignalError(msg)
        heard.append(message.data)

    stage.port.listen(Float64, 'number', hear, COMMAND)
    for active, value in ((True, 1.0), (False, 2.0), (True, -3.0), (True, 4.0)):
        stage.port.active = active
        data = codec(Float64).encode(Float64(data=value))
        stage.graph.feed('/oak/number', stage.graph.now, data)
    assert heard == [1.0, 4.0]
    assert stage.graph.complaints == {'node: refused: number: <negative>': 1}
