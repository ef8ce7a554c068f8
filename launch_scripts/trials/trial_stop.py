"""How soon STOP is a zero at the wheels: over a real graph, each node in a process of its own.

    python launch_scripts/trials/trial_stop.py --times 100

A robot drives at 20 Hz through the arbiter; somebody says STOP at any moment, on the topic; what
counts is the time from that message to the first command of zero that the motors would hear, after
which none but zeros may follow. Exits with 1 where the 99th percentile is above 200 ms.
"""

from __future__ import annotations

import argparse
import random
import signal
import subprocess
import sys
import time
from typing import TYPE_CHECKING

import numpy as np
import rclpy
from geometry_msgs.msg import TwistStamped
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool

from agv_motion.ros.qos import COMMAND

if TYPE_CHECKING:
    from collections.abc import Callable

LIMIT = 0.2
"""[s] for the 99th percentile"""

PATIENCE = 30.0
"""[s] for anything to happen at all"""

NODES = 'arbiter', 'differential_kinematics'
TALK = 0.05
"""[s] between two twists"""


class Trial:
    """Who drives, who says STOP, and what the motors hear."""

    def __init__(self) -> None:
        """Join the graph."""
        self.node = rclpy.create_node('trial_stop')
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self.node)
        self._agent = self.node.create_publisher(TwistStamped, 'cmd_vel/agent', COMMAND)
        self._stop = self.node.create_publisher(TwistStamped, 'cmd_vel/stop', COMMAND)
        self._release = self.node.create_client(SetBool, 'arbiter/stop')
        self.heard: list[tuple[float, bool]] = []
        """when the motors were commanded [s], and whether to turn"""
        self.node.create_subscription(JointState, 'wheels/command', self._on_command, COMMAND)
        self.node.create_timer(TALK, self._talk)

    def _on_command(self, message: JointState) -> None:
        self.heard.append((time.monotonic(), any(message.velocity)))

    def _talk(self) -> None:
        message = TwistStamped()
        message.header.stamp = self.node.get_clock().now().to_msg()
        message.twist.linear.x = 0.5
        self._agent.publish(message)

    def until(self, condition: Callable[[], bool]) -> None:
        """Spin until ``condition()``."""
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end:
                msg = f'nothing came for {PATIENCE:g} s: do the nodes live?'
                raise RuntimeError(msg)
            self._executor.spin_once(timeout_sec=0.02)

    def spin(self, seconds: float) -> None:
        """Spin for a while."""
        end = time.monotonic() + seconds
        self.until(lambda: time.monotonic() >= end)

    def once(self) -> float:
        """Drive, stop, and release; return how long the wheels went on [s]."""
        self.heard.clear()
        self.until(lambda: bool(self.heard) and self.heard[-1][1])
        self.spin(random.uniform(0.3, 0.5))  # noqa: S311 - a trial, no secret
        said = time.monotonic()
        self._stop.publish(TwistStamped())
        self.until(lambda: self.heard[-1][0] > said and not self.heard[-1][1])
        zero = self.heard[-1][0]
        self.spin(0.3)
        if any(turns for at, turns in self.heard if at > zero):
            msg = 'the wheels turned again, though STOP held'
            raise RuntimeError(msg)
        answer = self._release.call_async(SetBool.Request(data=False))
        self.until(answer.done)
        return zero - said


def main() -> None:
    """Say STOP again and again."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--times', type=int, default=100)
    times = parser.parse_args().times
    nodes = [subprocess.Popen([sys.executable, '-m', f'agv_motion.nodes.{n}']) for n in NODES]  # noqa: S603 - ours
    rclpy.init()
    try:
        trial = Trial()
        found = np.array([trial.once() for _ in range(times)])
    finally:
        rclpy.try_shutdown()
        for node in nodes:
            node.send_signal(signal.SIGINT)
            node.wait(PATIENCE)
    p50, p99 = np.percentile(found, (50, 99))
    print(
        f'STOP to zero at the wheels, {times} times: {1e3 * p50:.1f} ms median, '
        f'{1e3 * p99:.1f} ms p99, {1e3 * found.max():.1f} ms at most'
    )
    sys.exit(0 if p99 <= LIMIT else 1)


if __name__ == '__main__':
    main()
