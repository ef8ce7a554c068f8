"""A day of a tree by hand: what it did and drank, why it stood; and a page for any parser."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from math import nan
from xml.etree import ElementTree as ET

import pytest

pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, Vector3Stamped
from std_msgs.msg import String

from agv_motion.bag import BagReader, BagWriter
from agv_motion.errors import SourceError
from agv_motion.report.daily import read_day
from agv_motion.report.daily_page import page
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import type_name

NS = 1_000_000_000
NOON = 1434369600
EVIL = '<script>alert("x")</script> & \'so\' on'


class Recording:
    """A bag that is written message by message."""

    def __init__(self, path):
        self.writer, self.handles = BagWriter(path), {}

    def add(self, seconds, topic, message):
        kind = type(message)
        if topic not in self.handles:
            self.handles[topic] = self.writer.add_topic(topic, type_name(kind))
        stamp = int((NOON + seconds) * NS)
        self.writer.write(self.handles[topic], stamp, codec(kind).encode(message))


def status(name, level, message, **values):
    pairs = [KeyValue(key=key, value=value) for key, value in values.items()]
    return DiagnosticStatus(level=bytes([level]), name=name, message=message, values=pairs)


def pose(x, y):
    message = PoseWithCovarianceStamped()
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    return message


def litres(value):
    message = Vector3Stamped()
    message.vector.x, message.vector.y, message.vector.z = value, value / 2.0, 2.0 * value
    return message


def doing(activity, because, sentence):
    return status('/oak/motion_generator', 0, sentence, activity=activity, because=because)


def probes(flux, condition='good'):
    values = {'probe_1 condition': condition, 'probe_1 signal': 's1'}
    if flux is not None:
        values['probe_1 flux density [m/s]'] = f'{flux:.3e}'
    return status('/oak/granier_probe', 0, '', **values)


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    """Return a bag of 400 s: a tree walks 3 m, then rests since a probe is off."""
    path = tmp_path_factory.mktemp('bags') / 'day'
    made = Recording(path)
    zone = '{"boundary": [[0, 0], [10, 0], [10, 8], [0, 8]], "holes": [[[4, 4], [5, 4], [5, 5]]]}'
    made.add(0, '/oak/zone', String(data=zone))
    goal = PoseStamped()
    goal.pose.position.x, goal.pose.position.y = 4.0, 1.0
    made.add(0, '/oak/goal', goal)
    for second in range(0, 401, 10):
        walks = second < 200
        x = 1.0 + min(second, 200) * 3.0 / 200.0
        made.add(second, '/oak/pose', pose(nan if second == 300 else x, 1.0))
        words = 'walking to (4, 1)' if walks else f'resting: {EVIL}'
        now = doing('walking' if walks else 'resting', 'goal' if walks else 'probes', words)
        flux = (2e-6 if second < 100 else 4e-6) if walks else None
        made.add(second, '/oak/granier/water_use_today', litres(2.0 + 0.002 * second))
        reports = [now, probes(flux, 'good' if walks else 'off')]
        made.add(second, '/diagnostics', DiagnosticArray(status=reports))
        made.add(second, '/oak/driver', status('/oak/arbiter', 0, 'agent drives', driver='agent'))
        link = status('probe_1', 0 if walks else 1, f'probe 1 is off {EVIL}', because='')
        head = status('headline', 0, 'x')
        made.add(second, '/oak/why', DiagnosticArray(status=[head, link]))
    made.writer.close()
    return path


@pytest.fixture(scope='module')
def day(bag):
    with BagReader(bag) as reader:
        return read_day([reader])


def test_how_far_it_went_and_where(day):
    (oak,) = day.robots
    assert oak.name == 'oak'
    assert oak.walked == pytest.approx(3.0)
    assert oak.trail[-1] == pytest.approx((4.0, 1.0))
    assert [(goal.x, goal.y) for goal in oak.goals] == [(4.0, 1.0)]
    assert oak.no_numbers == 1


def test_what_it_drank_is_the_integral_of_the_flux(day):
    """2e-6 for 90 s, a step of 10 s in the mean of both, 4e-6 for 90 s."""
    (oak,) = day.robots
    assert oak.drunk() == pytest.approx(90 * 2e-6 + 10 * 3e-6 + 90 * 4e-6)


def test_litres_are_those_of_the_day_that_is_reported(day):
    """From 2 to 2.8 litres since midnight: 0.8 of them here."""
    (oak,) = day.robots
    assert oak.litres.total() == pytest.approx((0.8, 0.4, 1.6))


def test_what_it_did_and_who_drove(day):
    (oak,) = day.robots
    assert oak.doing.totals() == pytest.approx({'walking': 200.0, 'resting': 200.0})
    assert oak.drivers.totals() == pytest.approx({'agent': 400.0})
    assert oak.probes['probe_1'].conditions.totals() == pytest.approx({'good': 200.0, 'off': 200.0})


def test_a_probe_that_is_off_is_an_alert(day):
    (oak,) = day.robots
    (alert,) = oak.alerts()
    assert (alert.name, alert.level, alert.cleared) == ('probe_1', 'WARN', None)
    assert alert.raised == NOON + 230.0


def test_a_part_of_a_bag_is_the_part_of_a_day(bag):
    with BagReader(bag) as reader:
        day = read_day([reader], (NOON + 200) * NS, (NOON + 300) * NS)
    (oak,) = day.robots
    assert (day.begin, day.end) == (NOON + 200.0, NOON + 300.0)
    assert oak.walked == 0.0
    assert list(oak.doing.totals()) == ['resting']
    assert oak.drunk() is None


def test_without_a_robot_there_is_no_report(tmp_path):
    made = Recording(tmp_path / 'nothing')
    made.add(0, '/words', String(data='x'))
    made.writer.close()
    with BagReader(tmp_path / 'nothing') as reader, pytest.raises(SourceError, match='no robot'):
        read_day([reader])


VOID = {'meta', 'br'}


class Reader(HTMLParser):
    """Reads a page as a browser does: which elements are open, what is text, what is attribute."""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.open, self.tags, self.text, self.attributes = [], [], [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes += attributes
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes += attributes

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if 'style' not in self.open:
            self.text.append(data)


@pytest.fixture
def read(day):
    reader = Reader()
    reader.feed(page(day, ['bags/<day>'], 'Europe/Paris'))
    reader.close()
    assert reader.open == []
    return reader


def test_the_page_says_it_all_to_a_person(read):
    text = ' '.join(' '.join(read.text).split())
    assert 'Monday, 15 June 2015' in text
    assert '14:00 to 14:06 (Europe/Paris), 1 robot' in text
    assert 'It went 3.0 m , for 1 goal.' in text
    assert 'It drank 0.80 L (0.40 to 1.60) of water , with 95 % confidence.' in text
    assert 'It drank 0.6 litres of water per square metre of sapwood' in text
    assert f'14:03 14:06 3 min resting resting: {EVIL}' in text
    assert f'14:03 not over WARN probe 1 is off {EVIL}' in text
    assert 'probe_1 s1 good 50 %, off 50 % 0.6' in text
    assert '1 of its places or amounts held no number' in text
    assert 'From bags/<day>' in text
    assert not re.search(r'\bnan\b', text, re.IGNORECASE)


def test_the_page_needs_and_runs_nothing(read):
    assert not {'script', 'link', 'img', 'iframe', 'object', 'embed', 'a'} & {*read.tags}
    names = {name for name, _ in read.attributes}
    assert not {name for name in names if name.startswith('on')}
    assert not {'src', 'href', 'xlink:href', 'action'} & names
    assert ('name', 'viewport') in read.attributes
    assert ('content', "default-src 'none'; style-src 'unsafe-inline'") in read.attributes


def test_its_pictures_are_well_formed_and_say_what_they_show(day):
    drawings = re.findall(r'<svg.*?</svg>', page(day, []), re.DOTALL)
    assert len(drawings) == 2
    where, when = map(ET.fromstring, drawings)
    assert where.get('aria-label') == 'map: zone, way and goals of oak'
    assert len(where.findall('polygon')) == 2
    assert len(where.find('polyline').get('points').split()) == len(day.robots[0].trail)
    widths = [float(rect.get('width')) for rect in when.findall('rect')]
    assert widths == pytest.approx([1000.0, 500.0, 500.0])
    assert when.findall('rect')[2].find('title').text == f'resting: {EVIL}'
