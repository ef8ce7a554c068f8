"""A service is called and waited for; one that does not answer is told."""

from __future__ import annotations

import pytest

rclpy = pytest.importorskip('rclpy')

from std_srvs.srv import Trigger

from agv_motion.ros.remote_services import UnansweredError, call, call_all


@pytest.fixture
def two(monkeypatch):
    """Return a node that is spun by a call, and one that nobody spins."""
    context = rclpy.Context()
    rclpy.init(context=context)
    asker, deaf = (rclpy.create_node(name, context=context) for name in ('asker', 'deaf'))
    executor = rclpy.executors.SingleThreadedExecutor(context=context)
    executor.add_node(asker)
    spin = lambda _, timeout_sec: executor.spin_once(timeout_sec=timeout_sec)  # noqa: E731
    monkeypatch.setattr('agv_motion.ros.remote_services.rclpy.spin_once', spin)
    yield asker, deaf
    rclpy.try_shutdown(context=context)


def answered(_, response):
    response.message = 'here'
    return response


def test_an_answer_and_none(two):
    asker, deaf = two
    asker.create_service(Trigger, 'quick', answered)
    deaf.create_service(Trigger, 'slow', answered)
    assert call(asker, Trigger, '/quick', Trigger.Request()).message == 'here'
    with pytest.raises(UnansweredError, match=r'/slow is there, but did not answer within 0\.5 s'):
        call(asker, Trigger, '/slow', Trigger.Request(), 0.5)
    with pytest.raises(UnansweredError, match=r'/none was not there within 0\.2 s'):
        call(asker, Trigger, '/none', Trigger.Request(), 0.2)
    requests = {'/quick': Trigger.Request(), '/slow': Trigger.Request()}
    both = call_all(asker, Trigger, requests, 0.5)
    assert both['/quick'].message == 'here'
    assert isinstance(both['/slow'], UnansweredError)
    assert call_all(asker, Trigger, {}) == {}
