"""The board: the newest of each slot, in numbers that JSON has, and no growth."""

from __future__ import annotations

import json
from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.dashboard.core.board import Board
from agv_motion.dashboard.core.names import ALONE, MOST_ROBOTS, namespace_of, robot_of, split


def value(board, robot, slot):
    return json.loads(board.cells[robot, slot].update)['value']


def test_the_newest_message_counts(messages):
    board = Board()
    for x in range(10):
        board.receive('oak', 'pose', float(x), messages.pose(float(x)))
    board.refresh(9.5)
    assert value(board, 'oak', 'pose')['x'] == 9.0
    assert board.cells['oak', 'pose'].at == 9.0


def test_what_has_not_changed_is_not_made_anew(messages):
    board = Board()
    board.receive('oak', 'goal', 1.0, messages.goal(1.0, 2.0))
    board.refresh(1.0)
    version = board.cells['oak', 'goal'].version
    board.refresh(5.0)
    assert board.cells['oak', 'goal'].version == version
    board.receive('oak', 'goal', 6.0, messages.goal(1.0, 2.0))
    board.refresh(6.0)
    assert board.cells['oak', 'goal'].version > version


def test_nothing_is_decoded_that_nobody_looks_at():
    board, decoded = Board(), []
    for _ in range(100):
        board.receive('oak', 'pose', 1.0, b'', decoded.append)
        board.receive('oak', 'memory/sap_flow', 1.0, b'', decoded.append)
    board.refresh(1.0)
    assert len(decoded) == 1  # of the pose; the map is made for who asks for it
    board.refresh(1.1, {('oak', 'memory/sap_flow')})
    assert len(decoded) == 2


def test_turrets_in_any_order_have_speeds_when_the_radius_is_known(messages):
    board = Board()
    message = messages.turrets(angles=(0.1, 0.2), rates=(1.0, -2.0))
    order = [3, 0, 2, 1]
    message.name, message.position, message.velocity = (
        [values[i] for i in order] for values in (message.name, message.position, message.velocity)
    )
    board.receive('oak', 'turrets/state', 1.0, message)
    board.refresh(1.0)
    assert value(board, 'oak', 'turrets')['speeds'] == [None, None]
    board.set_platform('oak', {'kind': 'tree', 'wheel_radius': 0.1})
    board.refresh(1.1)
    turrets = value(board, 'oak', 'turrets')
    assert turrets['angles'] == [0.1, 0.2]
    assert turrets['speeds'] == [0.1, -0.2]


def test_the_centre_of_rotation_is_where_the_body_stands_still(messages):
    """A point p of the body moves by v + w x p; at the centre that is nothing."""
    board = Board()
    board.receive('oak', 'odom', 1.0, messages.odom(0.2, -0.1, 0.5))
    board.refresh(1.0)
    x, y = value(board, 'oak', 'twist')['icr']
    assert (0.2 - 0.5 * y, -0.1 + 0.5 * x) == pytest.approx((0.0, 0.0))
    board.receive('oak', 'odom', 2.0, messages.odom(0.2, 0.0, 0.0))
    board.refresh(2.0)
    assert value(board, 'oak', 'twist')['icr'] is None


NUMBERS = st.floats() | st.just(nan) | st.just(inf) | st.just(-inf)


@given(st.lists(NUMBERS, min_size=6, max_size=6))
def test_no_number_of_a_robot_makes_what_is_no_json(numbers):
    from test.dashboard.conftest import Messages as messages  # noqa: N813 - as the fixture

    board = Board()
    x, y, z, vx, vy, wz = numbers
    board.receive('oak', 'pose', 1.0, messages.pose(x, y, z, wz))
    board.receive('oak', 'odom', 1.0, messages.odom(vx, vy, wz))
    board.receive('oak', 'turrets/state', 1.0, messages.turrets((x, y, z), (vx, vy, wz)))
    board.receive('oak', 'granier/sap_flow', 1.0, messages.sap_flow(x, y, z))
    board.refresh(1.0)
    for cell in board.cells.values():
        json.loads(cell.update, parse_constant=pytest.fail)


@pytest.mark.parametrize(
    'topic',
    ['pose', 'odom', 'turrets/state', 'path', 'why', 'driver', 'zone', 'granier/sap_flow',
     'memory/sap_flow', 'standstill', 'state', 'sunlight', 'wheels/state', 'goal',
     'granier/water_use_today'],
)  # fmt: skip
def test_a_message_of_another_kind_harms_nothing(topic, messages):
    for message in (None, 7, 'x', object(), {}):
        board = Board()
        board.receive('oak', topic, 1.0, message)
        board.receive('ash', 'pose', 1.0, messages.pose())
        board.refresh(1.0, {('oak', topic)})
        board.refresh(3.0)
        assert value(board, 'ash', 'pose')['x'] == 1.0, message


def test_there_is_an_end_to_robots_nodes_and_texts(messages):
    board = Board()
    for i in range(100):
        board.receive(f'robot_{i}', 'pose', 1.0, messages.pose())
    assert len(board.robots) == MOST_ROBOTS
    statuses = [messages.status(f'/robot_0/node_{i}', message='x' * 9999) for i in range(500)]
    board.receive('', 'diagnostics', 1.0, messages.diagnostics(*statuses))
    board.refresh(1.0)
    assert len(board.robots['robot_0'].nodes) <= 60
    assert len(board.cells['robot_0', 'health'].update) < 100_000


def test_a_day_at_ten_hertz_grows_nothing(messages):
    """24 simulated hours, looked at every ten seconds: what is kept and sent has an end."""
    board = Board()
    sizes = []
    for step in range(8640):
        now = 10.0 * step
        x = step * 0.03
        board.receive('oak', 'pose', now, messages.pose(x % 20.0, x % 7.0))
        board.receive('oak', 'granier/sap_flow', now, messages.sap_flow(0.5, 0.4, 0.3, now))
        board.receive('', 'diagnostics', now, messages.diagnostics(messages.status('/oak/node')))
        board.look(now)
        if step % 2160 == 2159:
            board.refresh(now + 2.0)
            sizes.append(sum(len(cell.update) for cell in board.cells.values()))
    assert len(value(board, 'oak', 'day')['times']) <= 301
    assert len(value(board, 'oak', 'trail')['points']) <= 300
    assert sizes[-1] < 2 * sizes[1]
    assert value(board, 'oak', 'day')['drunk'] == pytest.approx(0.4 * 24.0, rel=0.02)


@pytest.mark.parametrize(
    ('namespace', 'robot'),
    [('', ALONE), ('/', ALONE), ('/oak', 'oak'), ('/yard/oak', 'yard.oak'), ('/robot', '.robot')],
)
def test_a_namespace_is_a_robot(namespace, robot):
    assert robot_of(namespace) == robot
    assert namespace_of(robot) == namespace.rstrip('/')


@pytest.mark.parametrize(
    'namespace', ['oak', '/<script>', '/oak/', '//oak', '/a b', '/1oak', '/oak\n', '/' + 'x' * 99]
)
def test_a_name_that_ros_does_not_have_is_none(namespace):
    assert robot_of(namespace) == ''


def test_a_topic_is_split_at_its_longest_known_end():
    assert split('/oak/memory/sap_flow') == ('oak', 'memory/sap_flow')
    assert split('/granier/sap_flow') == (ALONE, 'granier/sap_flow')
    assert split('/diagnostics') == ('', 'diagnostics')
    assert split('/oak/no/such') is None
