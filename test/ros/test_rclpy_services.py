"""Requests to rclpy's own services, at every node: answered, told, and the node lives on."""

from __future__ import annotations

import importlib

import pytest

rclpy = pytest.importorskip('rclpy')

from lifecycle_msgs.srv import ChangeState, GetState
from rcl_interfaces.msg import Parameter, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.experimental import EventsExecutor

from agv_motion.nodes.catalogue import available
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.plain_node import PlainNode

FITTING = {
    'unconfigured': {1, 5},
    'inactive': {2, 3, 6},
    'active': {4, 7},
}
NUMBERS = [*range(12), 20, 30, 40, 50, 60, 255]
"""Of all transitions that lifecycle_msgs knows, and some that it does not"""


class Executor:
    """The executor of live nodes, in place of that of the graph."""

    def __init__(self, graph, node):
        self.executor = EventsExecutor(context=graph.context)
        self.executor.add_node(node)
        self.client = graph.node('client')
        self.executor.add_node(self.client)
        self.node = node
        self.clients = {}

    def ask(self, kind, service, request):
        if service not in self.clients:
            name = f'{self.node.get_name()}/{service}'
            self.clients[service] = self.client.create_client(kind, name)
            self.until(self.clients[service].service_is_ready)
        future = self.clients[service].call_async(request)
        self.until(future.done)
        return future.result()

    def until(self, condition):
        while not condition():
            self.executor.spin_once(timeout_sec=0.1)

    def change(self, number=0, label=''):
        request = ChangeState.Request()
        request.transition.id, request.transition.label = number, label
        return self.ask(ChangeState, 'change_state', request).success

    def state(self):
        return self.ask(GetState, 'get_state', GetState.Request()).current_state.label


def kinds():
    """Return the class of every node of this package."""
    for name in available():
        module = importlib.import_module(f'agv_motion.nodes.{name}')
        yield next(
            kind
            for kind in vars(module).values()
            if isinstance(kind, type) and issubclass(kind, PlainNode)
            and kind.__module__ == module.__name__
        )  # fmt: skip


@pytest.fixture
def served(graph):
    """Return what makes a node and a client on the executor of live nodes."""
    made = []

    def make(kind):
        made.append(Executor(graph, LiveNode(kind, context=graph.context)))
        return made[-1]

    yield make
    for executor in made:
        executor.node.destroy_node()


@pytest.mark.timeout(120)
@pytest.mark.parametrize('kind', [*kinds()], ids=lambda kind: kind.__name__)
def test_a_transition_that_does_not_fit_the_state_is_refused(served, kind):
    served = served(kind)
    for numbers in ([], [1], [1, 3]):
        for number in numbers[-1:]:
            served.change(number)
        state = served.state()
        for wrong in (n for n in (1, 3, 4, 7, 255) if n not in FITTING[state]):
            assert not served.change(wrong)
        assert served.state() == state
    served.change(label='shutdown')
    assert served.state() == 'finalized'
    assert not served.change(label='activate')
    assert served.state() == 'finalized'


def test_every_number_in_every_state(served):
    served = served(DifferentialKinematics)
    for step, state in ((None, 'unconfigured'), (1, 'inactive'), (3, 'active')):
        if step is not None:
            assert served.change(step)
        for number in (n for n in NUMBERS if n not in FITTING[state]):
            assert not served.change(number)
            assert served.state() == state


def test_a_refusal_names_the_state_and_what_starts_there(served):
    served = served(DifferentialKinematics)
    served.change(label='deactivate')
    assert served.node.complaint == (
        "lifecycle: 'deactivate' does not start from the state 'unconfigured'; "
        'from there start configure, shutdown'
    )
    served.change(label='x' * 100_000)
    assert len(served.node.complaint) < 400


def test_a_parameter_of_a_type_that_there_is_not(served):
    served = served(DifferentialKinematics)
    strange = Parameter(name='track', value=ParameterValue(type=99))
    request = SetParameters.Request(parameters=[strange])
    assert not served.ask(SetParameters, 'set_parameters', request).results
    assert '99 is not a valid Parameter.Type' in served.node.complaint
