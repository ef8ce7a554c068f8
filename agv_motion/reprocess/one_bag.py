"""The nodes of a vehicle over one recorded bag, without middleware."""

from __future__ import annotations

import time
from contextlib import suppress
from itertools import islice
from math import inf
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import AgvMotionError
from agv_motion.files.unfinished import beside
from agv_motion.reprocess import provenance, wiring
from agv_motion.reprocess.bag_clock import BagClock
from agv_motion.reprocess.foreign.door import add, depends_on, watched
from agv_motion.reprocess.recorded import module_of, node_class, parameters
from agv_motion.reprocess.transcript import TOGETHER, Transcript
from agv_motion.ros.config import find_config
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.in_process_port import SERVICE_EVENT, full_name
from agv_motion.ros.messages import type_name

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from pathlib import Path

    from agv_motion.bag.connection import Message


NONE: dict[str, int] = {}


class Plan(NamedTuple):
    """What to run over each bag."""

    config: str
    """YAML file of parameters, as the nodes take it live"""
    nodes: tuple[str, ...]
    """in the order in which they start; an arbiter only where one was recorded"""
    remap: tuple[tuple[str, str], ...]
    """names of topics, relative ones in the namespace: as a node has it, as the bag has it"""
    compression: str
    namespace: str = '/'
    """of the nodes, such as ``/oak``"""
    foreign: tuple[str, ...] = ()
    """nodes of others, as ``package.module:Class``"""

    def names(self) -> dict[str, str]:
        """Return the remapping by full names."""
        return {full_name(a, self.namespace): full_name(b, self.namespace) for a, b in self.remap}

    def run(
        self, source: Path, target: Path, tell: Callable[[float], None] | None = None
    ) -> ReprocessOutcome:
        """Run the nodes over a bag: :func:`reprocess`, as `agv_motion.ros.many_bags` calls it."""
        return reprocess(source, target, self, tell)

    def modules(self) -> tuple[str, ...]:
        """Return the modules of the nodes."""
        return tuple(map(module_of, self.nodes))

    def apart(self) -> bool:
        """Return whether it needs a process of its own: what others do is looked after there."""
        return bool(self.foreign)

    def lost(self, source: Path, reason: str) -> ReprocessOutcome:
        """Return the outcome of a bag whose worker died."""
        return ReprocessOutcome(str(source), failure=reason)


class ReprocessOutcome(NamedTuple):
    """What came of one bag."""

    source: str
    messages_in: int = 0
    messages_out: int = 0
    seconds: float = 0.0
    """time that passed in the bag [s]"""
    took: float = 0.0
    """time that it took [s]"""
    missing: tuple[str, ...] = ()
    """inputs that the bag does not have"""
    complaints: Mapping[str, int] = NONE
    """warnings of the nodes, and how often"""
    failure: str = ''
    """why there is no result; empty if there is"""
    made_before: bool = False
    """whether an earlier run has made the same"""
    simulated: bool = False
    """whether the time was that of `/clock` in the bag"""
    problems: tuple[str, ...] = ()
    """what is amiss in the bag"""
    lossy: bool = False
    """whether something that the bag should hold could not be read"""


def reprocess(
    source: Path, target: Path, plan: Plan, tell: Callable[[float], None] | None = None
) -> ReprocessOutcome:
    """Run nodes over a bag; a failure is part of the outcome.

    Args:
        source: The bag.
        target: Where the result goes.
        plan: What to run.
        tell: Called now and then with the share of the recording that is done.

    """
    begin = time.perf_counter()
    try:
        return _run(source, target, plan, tell)._replace(took=time.perf_counter() - begin)
    except (AgvMotionError, OSError) as error:
        failure = str(error)
    except Exception as error:  # noqa: BLE001 - a defect in one bag must not stop the others
        failure = f'{type(error).__name__}: {error}'
    return ReprocessOutcome(str(source), took=time.perf_counter() - begin, failure=failure)


def _run(
    source: Path, target: Path, plan: Plan, tell: Callable[[float], None] | None
) -> ReprocessOutcome:
    given = {name: parameters(plan.config, name, plan.namespace) for name in plan.nodes}
    made_by = (
        given,
        plan._replace(config=''),
        _contents(given),
        depends_on(plan.foreign, plan.config),
    )
    digest = provenance.fingerprint(source, made_by)
    with BagReader(source) as bag:
        if provenance.is_made(target, digest):
            outcome = ReprocessOutcome(str(source), made_before=True)
        else:
            with beside(target) as made, watched(plan.foreign):
                outcome = _played(bag, made, plan, given, tell)
                provenance.note(made, source, digest)
        return outcome._replace(problems=tuple(map(str, bag.problems)), lossy=bag.lossy)


def _played(
    bag: BagReader,
    made: Path,
    plan: Plan,
    given: Mapping[str, Mapping[str, Any]],
    tell: Callable[[float], None] | None,
) -> ReprocessOutcome:
    """Run the nodes, with the parameters given to each, over an open bag."""
    with BagWriter(made, compression=plan.compression, chunk_duration=inf) as writer:
        transcript = Transcript(writer)
        clock = BagClock(bag)
        graph = InProcessGraph(transcript.record, clock.start)
        graph.recorded, graph.takes_rows = bag.topics, True
        own = wiring.nodes_for(plan.nodes, bag.topics, plan.namespace) if plan.nodes else ()
        for name in own:
            names = wiring.names_for(name, bag.topics, plan.namespace, plan.names())
            InProcessNode(graph, node_class(name), given[name], names, plan.namespace)
        for target in plan.foreign:
            add(graph, target, (plan.namespace, plan.names()), plan.config)
        drawn = Drawn(transcript, graph, bag, plan.namespace)
        graph.start()
        inputs, heard = graph.inputs(), 0
        drawn.own = (inputs | clock.topics) & set(bag.topics)
        for count, now in _feed(
            graph, bag.messages(sorted(drawn.own | drawn.topics)), clock, drawn
        ):
            heard += count
            if tell is not None:
                tell((now - bag.start) / max(bag.end - bag.start, 1))
        graph.run(clock.end())
        graph.stop()
        transcript.end(clock.end())
    missing = tuple(
        sorted(one for one in inputs - set(bag.topics) if not one.endswith(SERVICE_EVENT))
    )
    span = (clock.end() - clock.start) * 1e-9
    counts = heard, transcript.messages
    return ReprocessOutcome(
        str(bag.path), *counts, span, 0.0, missing, graph.complaints, simulated=bool(clock.topics)
    )


def _contents(given: Mapping[str, Mapping[str, Any]]) -> list[tuple[str, bytes]]:
    """Return the content of every file that is named in parameters."""
    found = []
    for value in (value for values in given.values() for value in values.values()):
        if isinstance(value, str) and value:
            with suppress(AgvMotionError, OSError, ValueError):
                found.append((value, find_config(value).read_bytes()))
    return found


class Drawn:
    """What transforms follow from of the recording, beside what the nodes hear."""

    def __init__(
        self, transcript: Transcript, graph: InProcessGraph, bag: BagReader, namespace: str
    ) -> None:
        """Let the transcript make transforms of one robot."""
        self.own: set[str] = set()
        """topics that the nodes hear"""
        own = namespace.rstrip('/')
        self.topics = transcript.make_transforms(
            {topic: type_name(ends[0].kind) for topic, ends in graph.publishers.items()},
            {topic: c.type for topic, c in bag.topics.items() if topic.rpartition('/')[0] == own},
        )
        self._transcript = transcript

    def heard(self, messages: list[Message], times: list[int]) -> list[tuple[Message, int]]:
        """Return those that the nodes hear, with their times [ns]; show the others."""
        if not self.topics:
            return list(zip(messages, times, strict=True))
        found = []
        for message, now in zip(messages, times, strict=True):
            topic = message.connection.topic
            if topic in self.topics:
                self._transcript.hear(topic, now, message.data)
            if topic in self.own:
                found.append((message, now))
        return found


def _feed(
    graph: InProcessGraph, messages: Iterator[Message], clock: BagClock, drawn: Drawn
) -> Iterator[tuple[int, int]]:
    """Let messages be heard, many shown beforehand; yield how many, and the log time [ns]."""
    feed = graph.feed
    while found := list(islice(messages, TOGETHER)):
        last = found[-1].stamp
        times = [clock.time_of(message) for message in found]
        together = drawn.heard(found, times)
        topics: dict[str, list[int]] = {}
        for i, (message, _) in enumerate(together):
            topics.setdefault(message.connection.topic, []).append(i)
        for topic, places in topics.items():
            shown = [together[i] for i in places]
            graph.look_ahead(topic, [m.data for m, _ in shown], [now for _, now in shown])
        for message, now in together:
            feed(message.connection.topic, now, message.data)
        yield len(together), last
