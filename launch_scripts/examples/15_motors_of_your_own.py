"""Your own motors: your controllers go where `here` stands, and stand when nobody commands."""

from contextlib import suppress
from time import monotonic

import rclpy
from sensor_msgs.msg import JointState

TIMEOUT, PERIOD = 0.5, 0.05  # [s]
angles = {f'turret_{i}_steering': 0.0 for i in range(3)}  # [rad]
rates = {f'turret_{i}_wheel': 0.0 for i in range(3)}  # [rad/s]
turned = dict.fromkeys(rates, 0.0)  # [rad] by each wheel since the start
heard = [monotonic()]


def on_command(told):
    """Turn, and roll."""
    heard[0] = monotonic()
    angles.update({n: told.position[i] for i, n in enumerate(told.name) if n in angles})  # here
    rates.update({n: told.velocity[i] for i, n in enumerate(told.name) if n in rates})  # here


def tell():
    """Stop where nobody commands, and tell what the encoders read."""
    if monotonic() - heard[0] > TIMEOUT:
        rates.update(dict.fromkeys(rates, 0.0))  # here
    turned.update({n: turned[n] + PERIOD * rate for n, rate in rates.items()})  # here
    state = JointState(name=[*angles, *rates], position=[*angles.values(), *turned.values()])
    state.velocity = [0.0] * 3 + [*rates.values()]
    state.header.stamp = node.get_clock().now().to_msg()
    publisher.publish(state)


rclpy.init()
node = rclpy.create_node('motors')
publisher = node.create_publisher(JointState, 'turrets/state', 1)
node.create_subscription(JointState, 'turrets/command', on_command, 1)
node.create_timer(PERIOD, tell)
with suppress(KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
    rclpy.spin(node)
