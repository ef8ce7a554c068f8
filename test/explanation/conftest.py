"""A robot that says what a test wants it to say, in messages of the shape that ROS has."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from agv_motion.explanation import Evidence, Explainer

NOON = 1434369600.0
"""[s] 2015-06-15 12:00 UTC"""


def status(name, level, message, **values):
    pairs = [SimpleNamespace(key=key, value=value) for key, value in values.items()]
    return SimpleNamespace(name=name, level=bytes([level]), message=message, values=pairs)


GOOD = {
    'probe_1 condition': 'good', 'probe_1 signal': 's1', 'probe_1 sap flow': '0.790',
    'probe_2 condition': 'good', 'probe_2 signal': 's2', 'probe_2 sap flow': '0.420',
    'probe_3 condition': 'good', 'probe_3 signal': 's3', 'probe_3 sap flow': '0.050',
    'source silent [s]': '0.3', 'source silent limit [s]': '75.0',
}  # fmt: skip


class Robot:
    """A tree that walks, unless a test says otherwise; `tell` says all of it at once."""

    def __init__(self):
        self.evidence, self.explainer = Evidence('/oak'), Explainer()
        self.now = 100.0
        self.wheels = 0, 'driving', {
            'held by': 'nobody', 'residual [m/s]': '0.00012', 'encoders age [s]': '0.05',
            'wheel speed [m/s]': '0.0103', 'commanded wheel speed [m/s]': '0.0100',
            'cmd_vel age [s]': '0.02', 'vx [m/s]': '0.01', 'vy [m/s]': '0.0', 'wz [rad/s]': '0.001',
        }  # fmt: skip
        self.decision = 0, 'walking to (3, 4)', {
            'activity': 'walking', 'because': 'goal', 'since [s]': str(NOON - 60.0),
            'limits in force': 'none', 'time zone': 'Europe/Paris',
        }  # fmt: skip
        self.probes = 0, 'all probes believable', dict(GOOD)
        self.localization = 0, 'odometry and fixes agree', {
            'state': 'tracking', 'odom': 'fresh', 'pose told': 'yes',
            'position deviation [m]': '0.043', 'heading deviation [rad]': '0.0071',
        }  # fmt: skip
        self.driver = None
        self.silent = set()

    def tell(self, seconds=0.5):
        """Let time pass, say everything that is not silent, and return the chain."""
        self.now += seconds
        if self.driver is not None and 'driver' not in self.silent:
            message = status('/oak/arbiter', *self.driver[:2], **self.driver[2])
            self.evidence.receive_driver(message, self.now)
        nodes = {
            'wheel_kinematics': self.wheels, 'motion_generator': self.decision,
            'granier_probe': self.probes, 'localization': self.localization,
        }  # fmt: skip
        told = [
            status(f'/oak/{name}', *told[:2], **told[2])
            for name, told in nodes.items() if name not in self.silent
        ]  # fmt: skip
        self.evidence.receive(SimpleNamespace(status=told), self.now)
        return self.chain()

    def chain(self):
        """Return the chain as it is now, without a word."""
        return self.explainer.explain(self.evidence, self.now, NOON + self.now - 100.0)

    def rest(self, because, message='resting', activity='resting', level=1):
        """Stand, as decided."""
        self.stand()
        values = self.decision[2] | {'activity': activity, 'because': because}
        self.decision = level, message, values

    def stand(self):
        """Command nothing and stand."""
        self.set_wheels(**dict.fromkeys(MOVING, '0.0'))

    def set_wheels(self, level=0, message='driving', **values):
        """Let the node of the wheels say something else."""
        self.wheels = level, message, self.wheels[2] | values


MOVING = ('wheel speed [m/s]', 'commanded wheel speed [m/s]', 'vx [m/s]', 'vy [m/s]', 'wz [rad/s]')


@pytest.fixture
def robot():
    return Robot()


@pytest.fixture
def link():
    """Return what finds a link of a chain by its name."""
    return lambda chain, name: next(one for one in chain.links if one.name == name)


@pytest.fixture
def judge(robot):
    """Return what asserts the first cause, the words and the level that follow from a change."""

    def follow(change, cause, words, level):
        change(robot)
        chain = robot.tell()
        assert chain.cause.name == cause
        assert words in chain.headline
        assert chain.level is level

    return follow
