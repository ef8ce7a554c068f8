"""The probe on a recording takes the readings that were recorded, and no others."""

from __future__ import annotations

from itertools import groupby

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import Temperature

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.reprocess import Plan, reprocess
from agv_motion.reprocess.recorded import parameters
from agv_motion.reprocess.recorded_probe import RecordedProbe
from agv_motion.reprocess.transcript import Transcript
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import stamp_of

SECOND = 1_000_000_000
NOON = 1434366000 * SECOND
READING = codec(Temperature)


def test_a_recorded_reading_is_said_again_with_its_value():
    """The simulated source, which would tell another one, is not asked."""
    said = []

    def record(publisher, _, data):
        if publisher.topic.endswith('/temperature_difference'):
            said.append((publisher.topic, READING.decode(data).temperature))

    graph = InProcessGraph(record, NOON)
    graph.recorded = ('/granier/probe_1/temperature_difference',)
    InProcessNode(graph, RecordedProbe, {'source': 'simulated'})
    graph.start()
    topic = '/granier/probe_1/temperature_difference'
    for second, value in ((5, 7.25), (15, 7.5)):
        message = Temperature(temperature=value)
        message.header.stamp = stamp_of(NOON + second * SECOND)
        graph.feed(topic, NOON + second * SECOND, READING.encode(message))
        graph.run(NOON + (second + 9) * SECOND)
    graph.stop()
    ours = [value for name, value in said if name == topic]
    assert ours
    assert set(ours) <= {7.25, 7.5}


DAWN = 1_370_822_400
"""[s] since 1970: the tenth of June 2013; the third night is the first without a wind"""
BEGIN, END = DAWN + 47 * 3600, DAWN + 62 * 3600
CONFIG = """
/**/granier_probe:
  ros__parameters:
    source: csv
    rate: 0.01
    water: {{sapwood_area: 0.012}}
    probe: {{zero_flow_method: environment, learning_hours: 1.0}}
    csv: {{file: {file}, start: '2013-06-11T23:00:00', radiation_column: sun, vpd_column: vpd}}
"""
FAST = """
/**/granier_probe:
  ros__parameters:
    source: csv
    rate: 0.5
    assign: [probe_1, probe_2, probe_1]
    probe: {{zero_flow_method: predawn, learning_hours: 1.0}}
    csv: {{file: {file}, start: '2013-06-10T12:00:00', speed: 3600.0}}
"""


@pytest.fixture(scope='module')
def by_the_air(tmp_path_factory):
    """Return a bag of a probe node whose zero flow is known by the air, and its parameters."""
    folder = tmp_path_factory.mktemp('air')
    rows = (
        f'{DAWN + 900 * k},{v},{v},{v},{max(0, 800 - abs(k % 96 - 50) * 30)},'
        f'{0.05 if k > 191 else 0.5}\n'
        for k in range(300)
        for v in [0.8 - 0.05 * max(0.0, 1.0 - abs(k % 96 - 56) / 24.0) + 1e-4 * (k % 3)]
    )
    (folder / 'probes.csv').write_text('time,probe_1,probe_2,probe_3,sun,vpd\n' + ''.join(rows))
    return recorded(folder, CONFIG, (BEGIN, END))


def recorded(folder, text, between):
    """Return a bag of a probe node, and how to reprocess it."""
    config = folder / 'mine.yaml'
    config.write_text(text.format(file=folder / 'probes.csv'))
    begin, end = between
    with BagWriter(folder / 'bag') as writer:
        transcript = Transcript(writer)
        graph = InProcessGraph(transcript.record, begin * SECOND)
        InProcessNode(graph, GranierProbe, parameters(str(config), 'granier_probe'))
        graph.start()
        graph.run(end * SECOND)
        graph.stop()
        transcript.flush()
    return folder / 'bag', Plan(str(config), ('granier_probe',), (), 'none')


def told(path, topic):
    """Return the values of a topic of vectors, one after the other, each once."""
    reader = codec(Vector3Stamped)
    with BagReader(path) as bag:
        if topic not in bag.topics:
            return []
        vectors = [reader.decode(m.data).vector for m in bag.messages([topic])]
    return [values for values, _ in groupby((v.x, v.y, v.z) for v in vectors)]


def test_zero_flow_is_known_by_the_air_that_was_recorded(by_the_air, tmp_path):
    """A reading is taken at the tick after it was said, so the last one may be missing."""
    bag, plan = by_the_air
    outcome = reprocess(bag, tmp_path / 'out', plan)
    assert not outcome.failure
    for topic in ('/granier/environment', '/granier/sap_flow', '/granier/water_use_today'):
        before, after = told(bag, topic), told(tmp_path / 'out', topic)
        assert len(before) > 5
        assert len(after) >= len(before) - 1
        assert after == before[: len(after)]


def test_without_the_recorded_air_zero_flow_is_unknown(by_the_air, copied, tmp_path):
    bag, plan = by_the_air

    def airless(message):
        kind = message.connection
        if kind.topic != '/granier/environment':
            yield kind.topic, message.stamp, message.data, kind.type

    airless_bag = copied(bag, tmp_path / 'airless', airless)
    outcome = reprocess(airless_bag, tmp_path / 'out', plan)
    assert outcome.missing == ('/granier/environment',)
    assert told(tmp_path / 'out', '/granier/sap_flow') == []


def test_nights_are_those_of_the_file_however_fast_it_was_played(tmp_path):
    """Two days in two times 24 s, eight rows at each tick: all of one stamp, at noon."""
    rows = (
        f'{DAWN + 900 * k},{v},{v},\n'
        for k in range(300)
        for v in [0.8 + 2e-3 * (k // 96) - 0.05 * max(0.0, 1.0 - abs(k % 96 - 56) / 24.0)]
    )
    (tmp_path / 'probes.csv').write_text('time,probe_1,probe_2,probe_3\n' + ''.join(rows))
    bag, plan = recorded(tmp_path, FAST, (NOON // SECOND, NOON // SECOND + 50))
    assert not reprocess(bag, tmp_path / 'out', plan).failure
    before, after = (told(each, '/granier/sap_flow') for each in (bag, tmp_path / 'out'))
    assert len(before) > 5
    assert len(after) >= len(before) - 1
    assert after == before[: len(after)]
