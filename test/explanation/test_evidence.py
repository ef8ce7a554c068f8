"""Whose words count: those of one robot, by their keys."""

from __future__ import annotations

from types import SimpleNamespace

from agv_motion.explanation import Evidence, Explainer


def held(by, words):
    def change(robot):
        robot.rest('goal', 'walking to (3, 4)', 'walking')
        robot.set_wheels(2, f'stopped: {words}', **{'held by': by})

    return change


def test_nodes_of_another_robot_and_sentences_decide_nothing(robot, link):
    """The same sentence with another key is another cause."""
    robot.rest('hours', 'resting: a probe cannot be believed', 'closed')
    chain = robot.tell()
    assert chain.cause.name == 'decision'
    robot.evidence.receive(other(), robot.now)
    assert robot.chain() == chain


def other():
    stranger = SimpleNamespace(name='/ash/wheel_kinematics', level=b'\x02', message='x', values=[])
    return SimpleNamespace(status=[stranger])


def test_a_robot_on_two_wheels_has_no_sap():
    evidence = Evidence()
    route = {'activity': 'driving', 'because': 'goal'}
    wheels = {
        'held by': 'nobody', 'encoders age [s]': '0.1', 'wheel speed [m/s]': '0.3',
        'cmd_vel age [s]': '0.1', 'vx [m/s]': '0.3', 'vy [m/s]': '0', 'wz [rad/s]': '0',
    }  # fmt: skip
    told = [said('/route_follower', 'following', route),
            said('/differential_kinematics', 'driving', wheels)]  # fmt: skip
    evidence.receive(SimpleNamespace(status=told), 5.0)
    chain = Explainer().explain(evidence, 5.1, 1000.0)
    assert [link.name for link in chain.links] == ['wheels', 'cmd_vel', 'decision', 'pose']
    assert chain.headline == 'wheels turn: following'
    assert chain.links[3].sentence == 'odometry alone tells where it is'


def said(name, message, values):
    pairs = [SimpleNamespace(key=key, value=value) for key, value in values.items()]
    return SimpleNamespace(name=name, level=0, message=message, values=pairs)
