"""The black box of the recorder on a real graph: triggers, marks, and what is refused."""

from __future__ import annotations

import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.qos import QoSProfile
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger

from agv_motion.bag.events.event import events_of
from agv_motion.bag.reader import BagReader
from agv_motion.nodes.bag_recorder import BagRecorder

RELIABLE = QoSProfile(depth=1000)


def test_triggers_and_marks_become_bags_with_what_came_before(tester, tmp_path, qos):
    state = tester.node.create_publisher(String, 'state', qos['latched'])
    residual = tester.node.create_publisher(Float64, 'turrets/residual', RELIABLE)
    mark = tester.node.create_publisher(String, 'bag_recorder/mark', RELIABLE)
    state.publish(String(data='walking'))
    node = tester.start(
        BagRecorder, output=str(tmp_path / 'bag'), topics=['state'], storage__keep_free=0.0,
        trigger=['state ~ stopped', '/turrets/residual > 0.02'], before=60.0, after=0.3,
        use_sim_time=False,
    )  # fmt: skip
    events = node.plain.events
    quiet = lambda: residual.publish(Float64(data=0.01))  # noqa: E731
    tester.graph.repeat(quiet, lambda: node.plain.recording.messages >= 5)
    tester.graph.spin_until(lambda: mark.get_subscription_count() == 1)

    residual.publish(Float64(data=0.05))
    tester.graph.spin_until(lambda: len(events.saved) == 1)
    state.publish(String(data='stopped: obstacle'))
    tester.graph.spin_until(lambda: len(events.saved) == 2)
    mark.publish(String(data='rain began'))
    tester.graph.spin_until(lambda: len(events.saved) == 3)
    answer = tester.ask(Trigger, 'bag_recorder/mark', Trigger.Request())
    assert answer.success
    assert "'marked' is marked: event_" in answer.message
    assert node.plain.diagnose().values['event now'] == 'marked'
    node.trigger_deactivate()

    reasons = []
    for path in events.saved:
        with BagReader(path) as bag:
            assert bag.problems == []
            (event,) = events_of(bag)
            reasons.append(event.first.reason)
            assert event.begin <= bag.start
            assert bag.counts['/turrets/residual'] >= 5
            assert bag.counts['/state'] >= 1
    assert reasons == ['/turrets/residual > 0.02', '/state ~ stopped', 'rain began', 'marked']
    assert events.saved[0].name.endswith('Z_turrets_residual_0.02')
    with BagReader(tmp_path / 'bag') as whole:
        assert set(whole.topics) == {'/state', '/turrets/residual'}
    assert not tester.ask(Trigger, 'bag_recorder/mark', Trigger.Request()).success
