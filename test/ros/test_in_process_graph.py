"""Order in a graph without middleware: timers before messages of their time, each by its number."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.ros.in_process_graph import MOST_COMPLAINTS, InProcessGraph


class Ear:
    """Hears, and may answer on another topic."""

    takes = None

    hears_itself = False

    def __init__(self, graph, log, answer=None):
        self.port, self._graph, self._log = self, graph, log
        self._answer = SimpleNamespace(topic=answer, port=self) if answer else None

    def look_ahead(self, messages, stamps):
        self._log.append(('ahead', messages, stamps))

    def hear(self, data):
        self._log.append((self._graph.now, data))
        if self._answer:
            self._graph.publish(self._answer, f'{data} answered')


@pytest.fixture
def log():
    return []


@pytest.fixture
def graph(log):
    return InProcessGraph(lambda publisher, now, data: log.append((publisher.topic, now, data)), 0)


def test_timers_run_by_their_time_and_then_by_their_number(graph, log):
    graph.add_timer(3e-9, lambda: log.append(('slow', graph.now)))
    graph.add_timer(2e-9, lambda: log.append(('quick', graph.now)))
    graph.run(6)
    assert log == [('quick', 2), ('slow', 3), ('quick', 4), ('slow', 6), ('quick', 6)]


def test_a_timer_of_no_time_does_not_stop_the_clock(graph, log):
    graph.add_timer(0.0, lambda: log.append(graph.now))
    graph.run(3)
    assert log == [1, 2, 3]


def test_a_timer_comes_before_a_message_of_its_time(graph, log):
    graph.add_timer(5e-9, lambda: log.append(('timer', graph.now)))
    graph.listeners['/in'] = [Ear(graph, log)]
    graph.start()
    graph.feed('/in', 5, b'x')
    assert log == [('timer', 5), (5, b'x')]


def test_but_after_one_that_a_node_here_publishes_too(graph, log):
    graph.add_timer(5e-9, lambda: log.append(('timer', graph.now)))
    graph.listeners['/in'] = [Ear(graph, log)]
    graph.publishers['/in'] = [SimpleNamespace(topic='/in', port=object())]
    graph.start()
    graph.feed('/in', 5, b'x')
    graph.run(5)
    assert log == [(5, b'x'), ('timer', 5)]


def test_answers_are_heard_after_all_messages_of_the_same_time(graph, log):
    graph.listeners['/in'] = [Ear(graph, log, answer='/out')]
    graph.listeners['/out'] = [Ear(graph, log)]
    graph.start()
    graph.feed('/in', 5, 'a')
    graph.feed('/in', 5, 'b')
    graph.feed('/in', 6, 'c')
    heard = [told for told in log if len(told) == 2]
    assert heard == [(5, 'a'), (5, 'b'), (5, 'a answered'), (5, 'b answered'), (6, 'c')]


def test_what_is_shown_beforehand_goes_to_those_who_listen(graph, log):
    graph.listeners['/in'] = [Ear(graph, log)]
    graph.look_ahead('/in', [b'x'], [7])
    graph.look_ahead('/other', [b'y'], [7])
    assert log == [('ahead', [b'x'], [7])]


def test_inputs_are_what_nobody_else_here_says(graph, log):
    one, other = Ear(graph, log), Ear(graph, log)
    graph.listeners = {'/own': [one], '/other': [one], '/outside': [other]}
    graph.publishers = {
        '/own': [SimpleNamespace(topic='/own', port=one)],
        '/other': [SimpleNamespace(topic='/other', port=other)],
    }
    assert graph.inputs() == {'/own', '/outside'}


def test_nothing_is_heard_before_all_are_active_nor_after_the_end(graph, log):
    ear = Ear(graph, log)
    graph.listeners['/out'] = [ear]
    speaker = SimpleNamespace(topic='/out', port=object())
    graph.nodes = [SimpleNamespace(
        activate=lambda: (graph.publish(speaker, 'begin'), log.append('active')),
        deactivate=lambda: graph.publish(speaker, 'end'),
    )]  # fmt: skip
    graph.start()
    assert log == [('/out', 0, 'begin'), 'active', (0, 'begin')]
    graph.stop()
    assert log[3:] == [('/out', 0, 'end'), (0, 'end')]


def test_complaints_are_counted_and_their_number_is_limited(graph):
    for number in range(MOST_COMPLAINTS + 5):
        graph.note_complaint(str(number))
    graph.note_complaint('0')
    assert len(graph.complaints) == MOST_COMPLAINTS
    assert graph.complaints['0'] == 2


def test_a_timer_that_is_dropped_is_called_no_more():
    graph, calls = InProcessGraph(lambda *_: None, 0), []
    first = graph.add_timer(1.0, lambda: calls.append('first'))
    graph.add_timer(1.0, lambda: calls.append('second'))
    graph.run(1_000_000_000)
    graph.drop_timer(first)
    graph.add_timer(0.5, lambda: calls.append('third'))
    graph.run(2_000_000_000)
    assert calls == ['first', 'second', 'third', 'second', 'third']
