"""Robots as messages without ROS, and a fleet of them that does what it is asked."""

from __future__ import annotations

import asyncio
from types import SimpleNamespace as Some

import pytest

from agv_motion.dashboard.core.board import Board


def header(seconds=0.0):
    return Some(stamp=Some(sec=int(seconds), nanosec=0), frame_id='')


class Messages:
    """What a robot says, as objects with the fields of ROS messages."""

    @staticmethod
    def pose(x=1.0, y=2.0, z=0.0, w=1.0):
        place = Some(position=Some(x=x, y=y, z=0.0), orientation=Some(x=0.0, y=0.0, z=z, w=w))
        return Some(header=header(), pose=Some(pose=place, covariance=[0.01] * 36))

    @staticmethod
    def goal(x, y):
        return Some(header=header(), pose=Messages.pose(x, y).pose.pose)

    @staticmethod
    def turrets(angles=(0.0, 0.1, 0.2), rates=(1.0, 2.0, 3.0)):
        count = len(angles)
        names = [f'turret_{i}_{what}' for what in ('steering', 'wheel') for i in range(count)]
        return Some(name=names, position=[*angles, *[0.0] * count],
                    velocity=[*[0.0] * count, *rates])  # fmt: skip

    @staticmethod
    def twist(vx=0.0, vy=0.0, wz=0.0):
        return Some(linear=Some(x=vx, y=vy, z=0.0), angular=Some(x=0.0, y=0.0, z=wz))

    @staticmethod
    def odom(vx=0.0, vy=0.0, wz=0.0):
        return Some(twist=Some(twist=Messages.twist(vx, vy, wz)))

    @staticmethod
    def status(name, level=0, message='', **values):
        pairs = [Some(key=key, value=str(value)) for key, value in values.items()]
        return Some(name=name, level=level, message=message, values=pairs)

    @staticmethod
    def diagnostics(*statuses):
        return Some(header=header(), status=list(statuses))

    @staticmethod
    def sap_flow(s1, s2, s3, seconds=0.0):
        return Some(header=header(seconds), vector=Some(x=s1, y=s2, z=s3))


class Robots:
    """A fleet without ROS: what was asked is kept, and answered as the test says."""

    def __init__(self, *names):
        self.board = Board()
        self.time = 1000.0
        for name in names:
            self.board.robot(name)
        self.asked = []
        self.values = {'rest.arrival': 1.0, 'rate': 10.0}
        """of the parameters of every robot"""
        self.driven = []
        self.answer = ''
        """in words; or an error, or None for no answer at all"""

    @property
    def robots(self):
        return sorted(self.board.robots)

    def now(self):
        return self.time

    def act(self, robot, action, arguments):
        self.asked.append((robot, action, arguments))
        future = asyncio.get_running_loop().create_future()
        if isinstance(self.answer, Exception):
            future.set_exception(self.answer)
        elif self.answer is not None:
            future.set_result(self.answer)
        return future

    async def parameters(self, robot):
        rows = [{'name': name, 'value': value, 'dynamic': name != 'rate'}
                for name, value in self.values.items()]  # fmt: skip
        return [{'node': 'motion_generator', 'rows': rows}]

    def drive(self, robot, twist, age):
        self.driven.append((robot, twist, age))

    def say(self, robot, topic, message, at=None):
        self.board.receive(robot, topic, self.time if at is None else at, message)


@pytest.fixture
def messages():
    """Return what makes messages."""
    return Messages


@pytest.fixture
def robots():
    """Return a fleet of an oak and an ash."""
    return Robots('oak', 'ash')
