"""Recordings on a real disk: split, in a ring, on a full disk, killed."""

from __future__ import annotations

import errno
import os
import shutil
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest
import yaml
from mcap.exceptions import McapError
from mcap.reader import SeekingReader
from mcap.records import Footer, Message
from mcap.stream_reader import StreamReader
from rosbags.rosbag2 import Reader

pytest.importorskip('std_msgs')

from agv_motion.bag.checks.check import Limits, check
from agv_motion.bag.completeness import completeness, together
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.bag.reader import BagReader
from agv_motion.bag.recording.recording import Recording
from agv_motion.bag.recording.storage_parameters import StorageParameters
from agv_motion.errors import ConfigurationError, SourceError

TEXT = 'std_msgs/msg/String'
SECOND = 1_000_000_000
VOLATILE = [OfferedQos()]
LATCHED = [OfferedQos(durability='transient_local', depth=1)]


def text(i, size=9):
    letters = f'{i:08d}'.ljust(size - 1).encode() + b'\0'
    return b'\0\1\0\0' + len(letters).to_bytes(4, 'little') + letters


def recording(path, **given):
    return Recording(path, StorageParameters(**{'keep_free': 0.0, **given}))


def numbers(path):
    """Return the numbers that rosbags finds in a bag, in order."""
    with Reader(path) as reader:
        return [int(data[8:16]) for _, _, data in reader.messages()]


@pytest.mark.parametrize(('publishers', 'lost'), [(0, 1), (1, 1), (2, 0)])
def test_a_number_that_is_missing_is_lost_unless_another_publisher_may_have_its_own(
    tmp_path, publishers, lost
):
    """Nobody seen counts as one: who has just left is not seen any more."""
    one = recording(tmp_path / 'bag')
    topic = one.add_topic('/text', TEXT, VOLATILE)
    one.set_publishers(topic, publishers)
    for i, number in enumerate((1, 2, 4)):
        one.put(topic, i, text(i), i, number)
    (report,) = one.close()
    assert report.lost == lost


def test_everything_handed_over_is_in_the_bag_and_reported(tmp_path):
    one = recording(tmp_path / 'bag')
    topic = one.add_topic('/text', TEXT, VOLATILE)
    for i in range(500):
        one.put(topic, i * SECOND, text(i), (i + 1) * SECOND, i + 1 + (i > 250))
    (report,) = one.close()
    assert numbers(tmp_path / 'bag') == list(range(500))
    assert (report.name, report.messages, report.lost, report.dropped) == ('/text', 500, 1, 0)
    assert report.rate == pytest.approx(1.0)
    assert report.longest_silence == pytest.approx(1.0)
    with (tmp_path / 'bag' / 'bag_0.mcap').open('rb') as stream:
        messages = list(SeekingReader(stream, validate_crcs=True).iter_messages())
    assert messages[3][2].publish_time == 4 * SECOND
    assert messages[3][2].sequence == 4


def test_each_file_tells_what_was_lost_and_dropped_of_its_messages(tmp_path):
    one = recording(tmp_path / 'bag', cache=1.0)
    topic = one.add_topic('/text', TEXT, VOLATILE)
    one.add_topic('/silent', TEXT, VOLATILE)
    for number in (1, 2, 4):
        one.put(topic, number, text(number), number, number)
    one.split()
    for number in (5, 6):
        one.put(topic, number, text(number), number, number)
    with one._lock:  # noqa: SLF001 - a disk that takes nothing meanwhile
        for number in (7, 8, 9):
            one.put(topic, number, text(number, 700_000), number, number)
    one.split()
    one.put(topic, 12, text(12), 12, 12)
    one.close()
    found = []
    for file in sorted((tmp_path / 'bag').glob('*.mcap')):
        with BagReader(file) as bag:
            found.append(completeness(bag))
    assert [one['/text'] for one in found] == [(3, 1, 0), (4, 0, 1), (1, 2, 0)]
    assert [one['/silent'] for one in found] == [(0, 0, 0)] * 3
    with BagReader(tmp_path / 'bag') as bag:
        told = completeness(bag)
        warnings = [f.text for f in check(bag, Limits()) if f.where == '/text']
    assert str(together(told)) == '66.66 % complete (3 lost on the way, 1 dropped)'
    assert any(str(told['/text']) in warning for warning in warnings)


def test_by_duration_a_new_file_begins_with_the_message_that_is_due(tmp_path):
    one = recording(tmp_path / 'bag', max_bag_duration=10.0)
    topic = one.add_topic('/text', TEXT, VOLATILE)
    for i in range(25):
        one.put(topic, i * SECOND, text(i), i * SECOND)
    one.close()
    assert numbers(tmp_path / 'bag') == list(range(25))
    description = yaml.safe_load((tmp_path / 'bag' / 'metadata.yaml').read_text())
    files = description['rosbag2_bagfile_information']['files']
    assert [file['message_count'] for file in files] == [10, 10, 5]
    starts = [file['starting_time']['nanoseconds_since_epoch'] for file in files]
    assert starts == [0, 10 * SECOND, 20 * SECOND]


def test_by_size_files_stay_near_the_limit(tmp_path, wait_until):
    one = recording(tmp_path / 'bag', max_bag_size=0.1, compression='none', flush_period=0.05)
    topic = one.add_topic('/text', TEXT, VOLATILE)
    for i in range(40):
        one.put(topic, i, text(i, 20_000), i)
        wait_until(lambda: i - one.messages < 4)  # noqa: B023 - it is called at once
    one.close()
    sizes = [file.stat().st_size for file in sorted((tmp_path / 'bag').glob('*.mcap'))]
    assert len(sizes) > 2
    assert all(100_000 <= size < 1_000_000 for size in sizes[:-1])
    assert numbers(tmp_path / 'bag') == list(range(40))


def test_a_ring_keeps_the_newest_files_and_what_was_latched(tmp_path):
    one = recording(tmp_path / 'bag', max_bag_duration=10.0, keep_files=2)
    latched = one.add_topic('/map', TEXT, LATCHED)
    topic = one.add_topic('/text', TEXT, VOLATILE)
    one.put(latched, 0, text(9999), 0)
    for i in range(55):
        one.put(topic, i * SECOND, text(i), i * SECOND)
    reports = one.close()
    assert [(report.messages, report.deleted) for report in reports] == [(3, 3), (25, 30)]
    names = sorted(file.name for file in (tmp_path / 'bag').glob('*.mcap'))
    assert names == ['bag_3.mcap', 'bag_4.mcap', 'bag_5.mcap']
    found = numbers(tmp_path / 'bag')
    assert [i for i in found if i != 9999] == list(range(30, 55))
    assert found.count(9999) == 3
    with Reader(tmp_path / 'bag') as reader:
        assert reader.start_time == 30 * SECOND


def test_every_file_of_a_split_recording_has_what_was_latched(tmp_path):
    one = recording(tmp_path / 'bag', max_bag_duration=10.0)
    latched = one.add_topic('/map', TEXT, LATCHED)
    topic = one.add_topic('/text', TEXT, VOLATILE)
    one.put(latched, 0, text(9999), 0)
    for i in range(25):
        one.put(topic, i * SECOND, text(i), i * SECOND)
    one.close()
    files = sorted((tmp_path / 'bag').glob('*.mcap'))
    found = []
    for file in files:
        with Reader(file) as reader:
            found.append([c.topic for c, _, _ in reader.messages()].count('/map'))
    assert found == [1, 1, 1]


def test_split_on_demand(tmp_path):
    one = recording(tmp_path / 'bag')
    topic = one.add_topic('/text', TEXT, VOLATILE)
    one.put(topic, 0, text(0), 0)
    one.split()
    one.put(topic, 1, text(1), 1)
    later = one.add_topic('/later', TEXT, VOLATILE)
    one.put(later, 2, text(2), 2)
    one.close()
    assert len(list((tmp_path / 'bag').glob('*.mcap'))) == 2
    assert numbers(tmp_path / 'bag') == [0, 1, 2]


def test_the_floor_ends_a_recording_clearly(tmp_path, wait_until):
    one = recording(tmp_path / 'bag', keep_free=1e9, flush_period=0.05)
    topic = one.add_topic('/text', TEXT, VOLATILE)
    one.put(topic, 0, text(0), 0)
    wait_until(lambda: one.failure)
    one.put(topic, 1, text(1), 1)
    (report,) = one.close()
    assert 'keep_free' in one.failure
    assert 'Errno' not in one.failure
    assert report.dropped == 1
    assert numbers(tmp_path / 'bag') == [0]


@pytest.fixture
def small_disk(tmp_path):
    """Return the folder of a tmpfs of 3 MB."""
    if os.geteuid() != 0:
        pytest.skip('mounting needs root')
    folder = tmp_path / 'disk'
    folder.mkdir()
    mount = ['mount', '-t', 'tmpfs', '-o', 'size=3m', 'tmpfs', str(folder)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:  # noqa: S603
        pytest.skip('mounting is not allowed here')
    yield folder
    subprocess.run(['umount', '-l', str(folder)], check=True)  # noqa: S603, S607


@pytest.mark.parametrize('size', [3_000, 300_000])
def test_a_full_disk_ends_a_recording_with_a_whole_bag(small_disk, size, wait_until):
    one = recording(small_disk / 'bag', compression='none', flush_period=0.05)
    topic = one.add_topic('/text', TEXT, VOLATILE)
    handed = 0
    while not one.failure:
        one.put(topic, handed, text(handed, size), handed)
        handed += 1
        wait_until(lambda: one.failure or (handed - one.messages) * size < 300_000)  # noqa: B023
    one.close()
    assert 'No space left' in one.failure
    assert 'Errno' not in one.failure
    found = numbers(small_disk / 'bag')
    assert found == list(range(len(found)))
    assert len(found) * size > 1_000_000
    with (small_disk / 'bag' / 'bag_0.mcap').open('rb') as stream:
        reader = SeekingReader(stream, validate_crcs=True)
        assert reader.get_summary().statistics.message_count == len(found)


def test_a_ring_on_a_small_disk_goes_on(small_disk, wait_until):
    one = recording(
        small_disk / 'bag', compression='none', flush_period=0.05, max_bag_size=0.4,
        keep_free=1.2, when_full='drop_oldest',
    )  # fmt: skip
    topic = one.add_topic('/text', TEXT, VOLATILE)
    for i in range(300):
        one.put(topic, i, text(i, 30_000), i)
        wait_until(lambda: one.failure or i - one.messages < 6)  # noqa: B023
    (report,) = one.close()
    assert not one.failure
    found = numbers(small_disk / 'bag')
    assert (report.messages, report.deleted) == (len(found), 300 - len(found))
    assert found == list(range(found[0], 300))
    assert found[0] > 200
    assert shutil.disk_usage(small_disk).free > 0.5e6


RECORDER = """
import sys, threading, time
from pathlib import Path
sys.path.insert(0, sys.argv[2])
from test_recording import VOLATILE, TEXT, recording, text
one = recording(Path(sys.argv[1]))
topic = one.add_topic('/text', TEXT, VOLATILE)
i = 0
pace = threading.Event()
while True:
    now = time.time_ns()
    one.put(topic, now, text(i), now)
    print(now, flush=True)
    i += 1
    pace.wait(0.001)
"""


def unfinished(file):
    """Yield number and log time of each message of a file without an end."""
    with file.open('rb') as stream, suppress(McapError):
        for record in StreamReader(stream, validate_crcs=True).records:
            assert not isinstance(record, Footer)
            if isinstance(record, Message):
                yield int(record.data[8:16]), record.log_time


def test_kill_9_loses_at_most_the_last_second(tmp_path):
    with subprocess.Popen(  # noqa: S603 - our own code
        [sys.executable, '-c', RECORDER, str(tmp_path / 'bag'), str(Path(__file__).parent)],
        stdout=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        first = last = int(process.stdout.readline())
        while last - first < 1.6 * SECOND:
            last = int(process.stdout.readline())
        process.send_signal(signal.SIGKILL)
    found = list(unfinished(tmp_path / 'bag' / 'bag_0.mcap'))
    assert [number for number, _ in found] == list(range(len(found)))
    assert last - found[-1][1] < SECOND


def test_a_stamp_that_fits_no_field_ends_a_recording_with_a_whole_bag(tmp_path, wait_until):
    one = recording(tmp_path / 'bag')
    topic = one.add_topic('/text', TEXT, VOLATILE)
    one.put(topic, 1, text(0), 1)
    one.put(topic, -1, text(1), 1)
    wait_until(lambda: one.failure)
    assert 'log time -1' in one.failure
    one.close()
    assert numbers(tmp_path / 'bag') == [0]


def test_a_type_that_is_not_installed_is_refused_and_the_recording_goes_on(tmp_path):
    one = recording(tmp_path / 'bag')
    with pytest.raises(ConfigurationError, match='nowhere_msgs'):
        one.add_topic('/x', 'nowhere_msgs/msg/Nothing', VOLATILE)
    topic = one.add_topic('/text', TEXT, VOLATILE)
    one.put(topic, 0, text(0), 0)
    one.close()
    assert numbers(tmp_path / 'bag') == [0]


def test_an_existing_folder_is_refused(tmp_path):
    with pytest.raises(SourceError, match='choose a new folder'):
        recording(tmp_path)


def test_a_disk_that_is_full_at_a_new_topic_ends_a_recording_with_a_whole_bag(
    tmp_path, monkeypatch
):
    one = recording(tmp_path / 'bag')
    topic = one.add_topic('/text', TEXT, VOLATILE)
    one.put(topic, 0, text(0), 0)

    def refuse(*_):
        raise OSError(errno.ENOSPC, 'No space left on device')

    with monkeypatch.context() as patch:
        patch.setattr(McapWriter, 'add_channel', refuse)
        with pytest.raises(SourceError, match='No space left'):
            one.add_topic('/later', TEXT, VOLATILE)
    with pytest.raises(SourceError, match='No space left'):
        one.add_topic('/later', TEXT, VOLATILE)
    (report,) = one.close()
    assert 'No space left' in one.failure
    assert 'Errno' not in one.failure
    assert report.name == '/text'
    with Reader(tmp_path / 'bag') as reader:
        assert [connection.topic for connection in reader.connections] == ['/text']
