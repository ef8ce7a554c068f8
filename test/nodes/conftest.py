"""A tester beside the node under test: sends, listens, asks for services."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, sin

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped, Vector3Stamped
from rcl_interfaces.msg import Log
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from std_msgs.msg import Bool, String

from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import COMMAND, LATCHED, SENSOR
from agv_motion.ros.run import start


class Tester:
    """One node that talks to the node under test over the real graph."""

    def __init__(self, graph):
        """Join the graph."""
        self.graph = graph
        self.node = graph.node('tester')
        self.received = {}

    def start(self, kind, *, activate=True, remap=(), **parameters):
        """Return a node with parameters as a YAML file gives them (``__`` for a dot)."""
        values = [Parameter(k.replace('__', '.'), value=v) for k, v in parameters.items()]
        arguments = ['--ros-args', *(word for pair in remap for word in ('-r', pair))]
        node = self.graph.add(
            LiveNode(
                kind, context=self.graph.context, parameter_overrides=values, cli_args=arguments
            )
        )
        if activate:
            start(node)
        self.graph.meet()
        return node

    def listen(self, kind, topic, qos=COMMAND):
        """Return the list into which messages of ``topic`` come; who speaks already is found."""
        inbox = self.received.setdefault(topic, [])
        self.node.create_subscription(kind, topic, inbox.append, qos)
        self.graph.meet()
        return inbox

    def logs(self):
        """Return the list into which comes what the nodes of this graph log from now on."""
        inbox = self.listen(Log, '/rosout', QoSProfile(depth=1000))
        self.graph.meet()
        return inbox

    def publisher(self, kind, topic, qos=COMMAND):
        """Return a publisher that has found its listener."""
        publisher = self.node.create_publisher(kind, topic, qos)
        self.graph.spin_until(lambda: publisher.get_subscription_count() >= 1)
        self.graph.meet()
        return publisher

    def ask(self, kind, service, request):
        """Return the answer of a service."""
        client = self.node.create_client(kind, service)
        self.graph.spin_until(client.service_is_ready)
        future = client.call_async(request)
        self.graph.spin_until(future.done)
        return future.result()

    def wait(self, inbox, condition=lambda message: True, timeout=60.0, saying=None):
        """Return the first message in ``inbox`` that fulfils ``condition``.

        Meanwhile ``saying()`` again and again: what is said once may be too old before it has done
        its work, where the machine is busy.
        """

        def found():
            return any(map(condition, inbox))

        try:
            if saying is None:
                self.graph.spin_until(found, timeout)
            else:
                self.graph.repeat(saying, found, timeout=timeout)
        except AssertionError as error:
            msg = f'{error}: of {len(inbox)} messages none fits; the last: {inbox[-3:]}'
            raise AssertionError(msg) from error
        return next(message for message in inbox if condition(message))


@pytest.fixture
def tester(graph, driven_robot):
    """Return a tester on the graph of this test, that can make a robot to be driven."""
    found = Tester(graph)
    found.driven_robot = driven_robot
    return found


class Senses:
    """A `motion_generator` and what it hears: sap flow, validity and pose."""

    def __init__(self, tester, **parameters):
        self.tester = tester
        self.commands = tester.listen(TwistStamped, 'cmd_vel')
        self.states = tester.listen(String, 'state', LATCHED)
        self.node = tester.start(MotionGenerator, **({'goal': [10.0, 5.0]} | parameters))
        self.flow = tester.publisher(Vector3Stamped, 'granier/sap_flow', SENSOR)
        self.pose = tester.publisher(PoseWithCovarianceStamped, 'pose', SENSOR)
        self.valid = tester.publisher(Bool, 'granier/valid', LATCHED)

    def feel(self, s1, s2, s3):
        message = Vector3Stamped()
        message.vector.x, message.vector.y, message.vector.z = s1, s2, s3
        self.flow.publish(message)

    def stand(self, x, y, heading, frame='map'):
        message = PoseWithCovarianceStamped()
        message.header.frame_id = frame
        message.pose.pose.position.x, message.pose.pose.position.y = x, y
        message.pose.pose.orientation.z = sin(heading / 2)
        message.pose.pose.orientation.w = cos(heading / 2)
        self.pose.publish(message)

    def moves(self):
        """Return the first command that moves."""
        return self.tester.wait(self.commands, self.moving)

    def rests(self):
        """Return the next command that does not move."""
        self.commands.clear()
        return self.tester.wait(self.commands, lambda m: not self.moving(m))

    @staticmethod
    def moving(message):
        """Return whether a command moves."""
        twist = message.twist
        return hypot(twist.linear.x, twist.linear.y) + abs(twist.angular.z) > 0.0


@pytest.fixture
def make_senses(tester):
    """Return what makes a `motion_generator` with parameters, and its senses."""
    return lambda **parameters: Senses(tester, **parameters)


@pytest.fixture
def qos():
    """Return the three profiles by name."""
    return {'command': COMMAND, 'sensor': SENSOR, 'latched': LATCHED}


NOON = 1434366000 * 10**9
"""[ns] of a day in June on which the sap flows"""


@dataclass(frozen=True)
class NoParameters:
    """Of a node that needs none."""


@pytest.fixture(scope='session')
def live_in_process():
    """Return what lets robots as launch files start them live for a while, without middleware."""
    from agv_motion.reprocess.recorded import LIVE_ONLY, node_class, parameters
    from agv_motion.ros.in_process_graph import InProcessGraph
    from agv_motion.ros.in_process_node import InProcessNode
    from agv_motion.ros.robot_graphs import ROBOTS

    class Driver(PlainNode):
        """Drives in a circle, as the lowest of all sources."""

        name, takes = 'driver', NoParameters

        def __init__(self, port, parameters):
            super().__init__(port, parameters)
            self.command = port.publisher(TwistStamped, 'cmd_vel/agent', COMMAND)
            port.every(0.1, self.drive)

        def drive(self):
            message = TwistStamped()
            self.port.stamp(message)
            message.twist.linear.x, message.twist.angular.z = 0.2, 0.3
            self.command.publish(message)

    def live(robot, namespaces, record, seconds, without=(), **given):
        graph = InProcessGraph(record, NOON)
        for namespace in namespaces:
            for node in ROBOTS[robot].nodes:
                if node.name in {'why', *LIVE_ONLY, *without}:
                    continue
                values = parameters(f'{robot}.yaml', node.name, namespace)
                values |= given.get(node.name, {}) | given.get('all', {})
                if node.name.endswith('simulator'):
                    values['clock'] = 'lead' if namespace == namespaces[0] else 'follow'
                start = namespace.rstrip('/')
                names = {f'{start}/{a}': f'{start}/{b}'.replace('{pose}', 'fix')
                         for a, b in node.remappings}  # fmt: skip
                InProcessNode(graph, node_class(node.name), values, names, namespace)
            if robot != 'tree':
                InProcessNode(graph, Driver, {}, {}, namespace)
        graph.start()
        graph.run(NOON + round(seconds * 10**9))
        graph.stop()
        return graph

    return live
