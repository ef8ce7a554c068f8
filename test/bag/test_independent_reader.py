"""Our files read by Foxglove's own readers, which share no code with Python's."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.writer import BagWriter

NODE = shutil.which('node')
pytestmark = pytest.mark.skipif(NODE is None, reason='Node.js is not installed')

SOURCE = Path(__file__).parent / 'independent_reader'
CACHE = Path(__file__).parents[2] / 'build' / 'independent_reader'
STORE = get_typestore(Stores.ROS2_JAZZY)
JOINTS = 'sensor_msgs/msg/JointState'
SECOND = 1_000_000_000
COMPRESSIONS = 'zstd', 'lz4', 'none'


def install(folder):
    """Install what the reader needs, or skip soon where there is no network."""
    patience = ['--fetch-retries=0', '--fetch-timeout=30000']
    npm = ['npm', 'install', '--no-audit', '--no-fund', '--loglevel=error', *patience]
    try:
        done = subprocess.run(  # noqa: S603 - our own command
            npm, cwd=folder, capture_output=True, text=True, timeout=120, check=False
        )
    except subprocess.TimeoutExpired:
        pytest.skip('npm installs nothing here within two minutes')
    if done.returncode:
        pytest.skip(f'npm installs nothing here: {done.stderr[-300:]}')


def joints(i):
    import numpy as np

    types = STORE.types
    header = types['std_msgs/msg/Header'](types['builtin_interfaces/msg/Time'](i, 5), f'tree_{i}')
    values = np.arange(i % 4) / 3.0
    content = types[JOINTS](header, [f'wheel_{j}' for j in range(i % 4)], values, values, values)
    return bytes(STORE.serialize_cdr(content, JOINTS))


def write(path, compression):
    definition, _ = STORE.generate_msgdef(JOINTS, ros_version=2)
    with BagWriter(path, compression=compression, chunk_size=1500) as writer:
        topic = writer.add_topic('/turrets/state', JOINTS, definition)
        for i in range(100):
            writer.write(topic, i * SECOND, joints(i))
    return path / f'{path.name}_0.mcap'


@pytest.fixture(scope='module')
def found(tmp_path_factory):
    """Return what the reader finds in a file of each compression, and in one with a wrong byte."""
    CACHE.mkdir(parents=True, exist_ok=True)
    wanted = (SOURCE / 'package.json').read_text()
    installed = CACHE / 'installed.json'
    for file in SOURCE.iterdir():
        shutil.copy(file, CACHE)
    if not installed.exists() or installed.read_text() != wanted:
        install(CACHE)
        installed.write_text(wanted)
    folder = tmp_path_factory.mktemp('read')
    files = {name: write(folder / name, name) for name in COMPRESSIONS}
    files['wrong'] = write(folder / 'wrong', 'none')
    content = bytearray(files['wrong'].read_bytes())
    content[content.index(b'tree_50') + 5] ^= 1
    files['wrong'].write_bytes(content)
    command = [NODE, str(CACHE / 'read.js'), *map(str, files.values())]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)  # noqa: S603, PLW1510
    assert done.returncode == 0, done.stderr
    return dict(zip(files, map(json.loads, done.stdout.splitlines()), strict=True))


@pytest.mark.parametrize('compression', COMPRESSIONS)
def test_foxglove_reads_every_field_and_finds_every_crc_right(found, compression):
    found = found[compression]
    assert found['done']
    assert found['header']['profile'] == 'ros2'
    assert found['statistics']['messageCount'] == '100'
    assert found['records']['Message'] == 100
    assert found['records']['ChunkIndex'] > 5
    for i, message in enumerate(found['messages']):
        values = [j / 3.0 for j in range(i % 4)]
        assert (message['topic'], message['stamp']) == ('/turrets/state', str(i * SECOND))
        assert message['message'] == {
            'header': {'stamp': {'sec': i, 'nanosec': 5}, 'frame_id': f'tree_{i}'},
            'name': [f'wheel_{j}' for j in range(i % 4)],
            'position': values,
            'velocity': values,
            'effort': values,
        }


def test_the_reader_would_see_a_wrong_byte(found):
    assert 'crc' in found['wrong']['error'].lower()
