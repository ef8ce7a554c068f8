"""The MQTT source at brokers: one of our own for what a broker seldom does, and mosquitto."""

from __future__ import annotations

import random
import shutil
import ssl
import subprocess
import sys
import threading
from datetime import datetime, timezone
from math import isfinite, isnan

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe.sources import attempts
from agv_motion.probe.sources.mqtt_connection import MqttMessage
from agv_motion.probe.sources.mqtt_parameters import MqttParameters
from agv_motion.probe.sources.mqtt_source import MqttSource
from agv_motion.probe.sources.sources import SourceParameters

pytest.importorskip('paho.mqtt.client')

NOON = datetime(2013, 6, 10, 12, tzinfo=timezone.utc).timestamp()
TOPIC = 'oak/probes'


def line(second, values='0.750 0.760 0.770'):
    """Return a line of a few seconds after noon."""
    return f'10-06-13 12:00:{second:02d} {values}'.encode()


def threads():
    return [thread for thread in threading.enumerate() if thread.name == 'mqtt probes']


@pytest.fixture
def opened():
    """Return what opens sources; all are closed in the end, and their threads are gone."""
    sources = []

    def open_source(port, **given):
        given = {'host': '127.0.0.1', 'port': port, 'topics': (TOPIC,)} | given
        sources.append(MqttSource(MqttParameters(**given)))
        return sources[-1]

    yield open_source
    for source in sources:
        source.close()
    assert threads() == []


@pytest.fixture
def subscribed(opened, wait_until):
    """Return what opens a source that the broker knows of."""

    def subscribe(broker, **given):
        source = opened(broker.port, **given)
        source.read(NOON)
        wait_until(lambda: source._connection.subscribed)  # noqa: SLF001 - nothing has come yet
        if hasattr(broker, 'clients'):
            wait_until(lambda: broker.clients)
        return source

    return subscribe


@pytest.fixture
def told(wait_until):
    """Return what reads a source until so many samples and such a word of complaint have come."""

    def read(source, count=0, word='', now=NOON):
        samples, complaints = [], []

        def done():
            samples.extend(source.read(now))
            complaints.append(source.complaint())
            return len(samples) >= count and word in '; '.join(complaints)

        wait_until(done)
        return samples, '; '.join(filter(None, complaints))

    return read


@pytest.fixture(params=['small', 'mosquitto'])
def broker(request):
    if request.param == 'mosquitto':
        return request.getfixturevalue('mosquitto')
    return request.getfixturevalue('small_broker')()


def test_lines_become_samples(broker, subscribed, told):
    source = subscribed(broker, topics=('oak/lines',))
    broker.publish('oak/lines', line(1) + b'\r\n' + line(2) + b'\x04\n')
    samples, complaint = told(source, 2)
    assert [sample.time - NOON for sample in samples] == [1.0, 2.0]
    assert samples[0].values == pytest.approx((18.75, 19.0, 19.25))
    assert complaint == ''


def test_what_the_broker_has_kept_is_no_new_reading(broker, opened, told):
    kept = b'10-06-13 12:00:00 0.1 0.1 0.1'
    broker.publish('oak/kept', kept, retain=True)
    source = opened(broker.port, topics=('oak/kept',))
    _, complaint = told(source, word='has kept a message')
    assert 'left out; told once' in complaint
    broker.publish('oak/kept', line(9), retain=True)
    samples, complaint = told(source, 1)
    assert [sample.time - NOON for sample in samples] == [9.0]
    assert complaint == ''


def test_json_of_any_member(small_broker, subscribed, told):
    broker = small_broker()
    source = subscribed(broker, format='json', json_keys=('dT.0', 'dT.1', 'x'), unit='K')
    broker.publish(TOPIC, b'{"dT": [18.5, NaN],\n "x": 1e999, "time": "2013-06-10T12:00:05Z"}')
    broker.publish(TOPIC, b'{"dT": [18.5, 19.5], "time": "2013-06-10T12:00:06Z"}')
    (sample,), complaint = told(source, 1, "no member 'x'")
    assert sample.time == NOON + 5.0
    assert sample.values[0] == 18.5
    assert all(map(isnan, sample.values[1:]))
    assert 'give json_keys' in complaint


def test_what_is_sent_twice_or_late_is_left_out_and_told(small_broker, subscribed, told):
    broker = small_broker()
    source = subscribed(broker)
    for text in (line(5), line(5), line(4), b'10-06-13 11:00:00 1 2 3', b'11-06-13 12:00:00 1 2 3'):
        broker.publish(TOPIC, text, dup=True)
    broker.publish(TOPIC, line(6))
    samples, complaint = told(source, 2)
    assert [sample.time - NOON for sample in samples] == [5.0, 6.0]
    assert 'was sent twice: left out' in complaint
    assert 'is older than the line before it: left out' in complaint


@pytest.mark.parametrize(
    ('text', 'word'),
    [
        (b'10-06-13 11:49:59 1 2 3', '601 s behind the clock here'),
        (b'10-06-13 12:10:01 1 2 3', '601 s ahead of the clock here'),
    ],
)
def test_a_time_far_from_the_clock_is_no_new_reading(opened, text, word):
    source = opened(1)
    message = MqttMessage(TOPIC, text, retained=False, repeated=False, at=0.0)
    assert list(source._samples(message, NOON)) == []  # noqa: SLF001 - needs no broker
    assert f'{word} (mqtt.max_age 600 s): left out; set the clock' in source.complaint()
    assert len(list(source._samples(message, 0.0))) == 1  # noqa: SLF001 - no clock yet to judge by


def test_lines_without_time_are_stamped_when_they_came(small_broker, subscribed, told, wait_until):
    broker = small_broker()
    source = subscribed(broker, format='arrival')
    for again in (False, True, False):
        broker.publish(TOPIC, b'T1=0.750 T2=0.760 T3=0.770', dup=again)
    broker.publish(TOPIC, b'rubbish 1')
    samples, complaint = told(source, 2, 'rubbish')
    assert len(samples) == 2  # the same value again is a reading, the same message is none
    assert NOON - 60.0 < samples[0].time <= samples[1].time <= NOON
    assert 'was sent twice' in complaint


def test_what_comes_came_after_the_last_reading(small_broker, subscribed):
    """A clock of ROS that stands or leaps does not mix up the order of what arrives."""
    source = subscribed(small_broker(), format='arrival')
    for now, earliest in ((NOON + 2.0, NOON), (NOON + 2.0, NOON + 2.0), (NOON - 5.0, NOON - 5.0)):
        long_ago = MqttMessage(TOPIC, b'1 2 3', retained=False, repeated=False, at=0.0)
        source._connection._messages.append(long_ago)  # noqa: SLF001 - by the steady clock
        (sample,) = source.read(now)
        assert sample.time == earliest


def test_each_probe_may_have_a_topic(small_broker, subscribed, told):
    broker = small_broker()
    topics = ('oak/1', 'oak/2', 'oak/3')
    source = subscribed(broker, topics=topics, fields=(1, 1, 2), unit='K')
    for topic, text in zip(topics, ('18.0', '19.0', '7 20.0'), strict=True):
        broker.publish(topic, line(3, text))
    broker.publish('oak/3', line(33, '7'))
    (sample,), complaint = told(source, 1, 'field 2 is missing')
    assert (sample.time, sample.values) == (NOON + 3.0, (18.0, 19.0, 20.0))
    assert "on 'oak/3' has 1 values" in complaint


def test_another_logger_under_the_same_filter_is_left_out(small_broker, subscribed, told):
    broker = small_broker()
    source = subscribed(broker, topics=('+/probes',))
    broker.publish('oak/probes', line(1))
    broker.publish('elm/probes', line(2))
    broker.publish('oak/probes', line(3))
    samples, complaint = told(source, 2)
    assert [sample.time - NOON for sample in samples] == [1.0, 3.0]
    assert "'elm/probes' is another logger than 'oak/probes'" in complaint


def test_silence_is_told_once_with_what_came_last(small_broker, subscribed, told):
    broker = small_broker()
    source = subscribed(broker, period=10.0)
    source.read(NOON + 31.0)
    assert source.complaint().startswith(
        f"nothing has come in 31 s from 127.0.0.1:{broker.port} on ['{TOPIC}']: look whether"
    )
    broker.publish(TOPIC, line(40))
    told(source, 1, now=NOON + 41.0)
    for _ in range(2):
        source.read(NOON + 80.0)
    complaint = source.complaint()
    assert complaint.count('nothing has come for') == 1
    assert complaint.endswith(f"the last was '{line(40).decode()}'")


def test_a_broker_that_goes_away_is_told_and_tried_again(small_broker, subscribed, told):
    broker = small_broker()
    source = subscribed(broker)
    broker.close()
    _, complaint = told(source, word='trying again in 2 s')
    where = f'127.0.0.1:{broker.port}'
    assert f'{where} has gone (' in complaint
    assert f'{where} is not reachable (' in complaint
    broker = small_broker(port=broker.port)
    told(source, word=f'{where} is there again')
    broker.publish(TOPIC, line(50))
    assert len(told(source, 1)[0]) == 1


def test_pauses_grow():
    each = attempts.Attempts()
    assert [each.fail() for _ in range(7)] == [1.0, 2.0, 4.0, 8.0, 16.0, 30.0, 30.0]


def test_a_password_of_a_file_is_sent_and_read_anew(small_broker, subscribed, told, tmp_path):
    broker, path = small_broker(), tmp_path / 'password'
    path.write_text('open sesame\n')
    source = subscribed(broker, user='tree', password_file=str(path), client_id='oak')
    path.write_text('open too')
    broker.drop()
    told(source, word='is there again')
    assert broker.heard == [[b'oak', b'tree', b'open sesame'], [b'oak', b'tree', b'open too']]


def test_a_password_that_is_refused_is_never_told(small_broker, opened, told, monkeypatch):
    broker = small_broker()
    broker.refuse = 5
    monkeypatch.setenv('TREE_PASSWORD', 'open sesame')
    source = opened(broker.port, user='tree', password_env='TREE_PASSWORD')  # noqa: S106 - a name
    _, complaint = told(source, word='refuses this client')
    assert broker.heard[0][1:] == [b'tree', b'open sesame']
    assert 'Not authorized' in complaint
    assert 'check mqtt.user, its password and client_id; trying again in 1 s' in complaint
    assert 'sesame' not in complaint + repr(source._given)  # noqa: SLF001 - whatever is printed


def test_a_topic_that_may_not_be_read_is_told(small_broker, opened, told):
    broker = small_broker()
    broker.refuse_topics = True
    source = opened(broker.port)
    told(source, word=f"refuses the topics ['{TOPIC}']: check what the user may read")


def test_closing_ends_the_thread_whatever_it_does(small_broker, subscribed, opened, wait_until):
    source = subscribed(small_broker())
    source.close()
    source.close()
    assert source.read(NOON) == []
    waits = opened(1)
    waits.read(NOON)
    wait_until(threads)
    waits.close()
    assert threads() == []


@pytest.mark.filterwarnings('ignore::pytest.PytestUnraisableExceptionWarning')
def test_tls_trusts_whom_it_is_told_to(small_broker, opened, subscribed, told, tmp_path):
    """The client leaves the socket of a handshake that fails to the collector, with a warning."""
    key, certificate = tmp_path / 'key', tmp_path / 'certificate'
    openssl = shutil.which('openssl')
    if openssl is None:
        pytest.skip('openssl is not installed')
    subprocess.run(  # noqa: S603 - of our own making
        [openssl, 'req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:P-256', '-nodes',
         '-subj', '/CN=127.0.0.1', '-addext', 'subjectAltName=IP:127.0.0.1', '-keyout', key,
         '-out', certificate], check=True, capture_output=True,
    )  # fmt: skip
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    context.load_cert_chain(certificate, key)
    broker = small_broker(tls=context)
    source = subscribed(broker, tls=True, tls_ca_file=str(certificate))
    broker.publish(TOPIC, line(1))
    assert len(told(source, 1)[0]) == 1
    _, complaint = told(opened(broker.port, tls=True), word='is not reachable')
    assert 'certificate' in complaint
    assert 'check mqtt.tls, tls_ca_file' in complaint


@pytest.mark.parametrize(
    ('given', 'word'),
    [
        ({'topics': ()}, 'one for all probes'),
        ({'topics': ('',)}, 'give one such as'),
        ({'topics': ('a/#/b',)}, 'give one such as'),
        ({'topics': ('a/b+',)}, 'give one such as'),
        ({'topics': ('a', 'b')}, 'one for each of fields'),
        ({'topics': ('a', 'a', 'b')}, 'one for each of fields'),
        ({'topics': ('a', '+', 'b')}, 'no [+] or #'),
        ({'topics': ('a', 'b', 'c'), 'vpd_field': 4}, 'one topic that tells all'),
        ({'host': 'mqtt://broker'}, 'name or address alone'),
        ({'port': 0}, 'port = 0'),
        ({'qos': 3}, 'qos = 3'),
        ({'max_age': float('nan')}, 'max_age = nan'),
        ({'password_env': 'X'}, 'give user too'),
        ({'password_env': 'X', 'password_file': 'y', 'user': 'z'}, 'give one of them'),
        ({'tls_ca_file': 'x'}, 'set tls to true'),
        ({'tls': True, 'tls_ca_file': '/no/such'}, "tls_ca_file = '/no/such' cannot be used"),
        ({'user': 'z', 'password_env': 'NO_SUCH_WORD'}, 'NO_SUCH_WORD: no such environment'),
        ({'user': 'z', 'password_file': '/no/such'}, '/no/such cannot be read: No such file'),
    ],
)
def test_what_cannot_be_is_refused_before_it_begins(given, word):
    with pytest.raises(ConfigurationError, match=word):
        MqttSource(MqttParameters(**given))


def test_without_the_extra_the_error_names_it(monkeypatch):
    monkeypatch.setitem(sys.modules, 'paho.mqtt', None)
    given = SourceParameters(source='mqtt')
    assert given.probes() == 3
    with pytest.raises(ConfigurationError, match=r'pip install "agv_motion\[mqtt\]"'):
        given.open_source()


def test_no_message_whatever_is_uncaught_or_infinite(opened):
    """Bytes changed, cut and put in: each message is samples, or told."""
    some = random.Random(1)  # noqa: S311 - a draw
    good = (
        line(1),
        b'{"time": "2013-06-10T12:00:00Z", "probe_1": 1, "probe_2": 1, "probe_3": 2}',
    )
    sources = [opened(1), opened(1, format='json'), opened(1, format='arrival')]
    for number in range(1000):
        payload = bytearray(good[number % 2])
        for _ in range(some.randrange(4)):
            at = some.randrange(len(payload) + 1)
            payload[at : at + some.randrange(3)] = some.randbytes(some.randrange(3))
        message = MqttMessage(TOPIC, bytes(payload), retained=False, repeated=False, at=0.0)
        for source in sources:
            for sample in source._samples(message, NOON + number):  # noqa: SLF001 - needs no broker
                assert isfinite(sample.time)
                assert not any(value in {float('inf'), -float('inf')} for value in sample.values)
    assert all(source.complaint() for source in sources)
