"""`agv service` says what `ros2 service` says, and does not wait for ever."""

from __future__ import annotations

import pytest

rclpy = pytest.importorskip('rclpy')

from std_srvs.srv import SetBool


def test_list_type_find_and_info(alone, oak):
    name, kind = f'{oak}/get_state', 'lifecycle_msgs/srv/GetState'
    assert f'{name} [{kind}]' in alone('service', 'list', '-t')[1].splitlines()
    assert alone('service', 'type', name) == (0, f'{kind}\n', '')
    assert name in alone('service', 'find', kind)[1].splitlines()
    told = alone('service', 'info', name)[1]
    assert told == f'Type: {kind}\nClients count: 0\nServices count: 1\n'


def test_call(alone, oak):
    told = alone('service', 'call', f'{oak}/get_state', 'lifecycle_msgs/srv/GetState')
    assert told == (
        0,
        (
            'requester: making request: lifecycle_msgs.srv.GetState_Request()\n\nresponse:\n'
            'lifecycle_msgs.srv.GetState_Response(current_state=lifecycle_msgs.msg.State(id=3, '
            "label='active'))\n\n"
        ),
        '',
    )


def test_call_with_values(agv, graph):
    node = graph.add(rclpy.create_node('server', context=graph.context))

    def answer(request, response):
        response.success, response.message = request.data, 'done'
        return response

    node.create_service(SetBool, 'switch', answer)
    _, out, _ = agv('service', 'call', '/switch', 'std_srvs/srv/SetBool', '{data: true}')
    assert "SetBool_Response(success=True, message='done')" in out


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        (('type', '/oak/wheel_kinematics/get_stat'), "did you mean '/oak/wheel_kinematics/get_st"),
        (('call', '/none', 'std_srvs/srv/Triger'), "did you mean 'Trigger'?"),
        (('call', '/none', 'no_srvs/srv/Trigger'), "package 'no_srvs' has no srv"),
        (('call', '/none', 'std_srvs/srv/SetBool', '{date: 1}'), "did you mean 'data'?"),
        (('call', '/none', 'std_srvs/srv/Trigger', '--timeout', '0.5'), 'no service /none within'),
    ],
)
def test_mistakes(alone, oak, words, error):
    status, _, errors = alone('service', *words)
    assert status == 1
    assert error in errors
    assert 'Traceback' not in errors
