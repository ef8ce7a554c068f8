"""`agv bag note`, `list`, `du` and `convert`: said, listed, carried along."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from agv_motion.bag import BagWriter
from agv_motion.bag.mcap.records import Attachment, Metadata

_SPEC = importlib.util.spec_from_file_location(
    'test_edit', Path(__file__).with_name('test_edit.py')
)
edits = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(edits)
run = edits.run


@pytest.fixture
def walk(tmp_path):
    with BagWriter(tmp_path / 'walk') as bag:
        topic = bag.add_topic('/a', 'a/msg/A', 'int8 data', type_hash='')
        for i in range(100):
            bag.write(topic, (100 + i) * edits.SECOND, b'\0\1\0\0' + bytes((i,)))
        bag.keep(Attachment(5, 5, '../calibration.yaml', 'text/yaml', b'turret: 1\n'))
        bag.keep(Metadata('site', {'wood': 'spruce'}))
    return tmp_path / 'walk'


def test_a_note_is_shown_by_info_echo_plot_and_list_and_carried_along(walk, tmp_path):
    pytest.importorskip('matplotlib')
    status, out = run('note', walk, 'rain began', '--at', '00:02:00')
    assert (status, 'noted at' in out, '20.000 s after the start' in out) == (0, True, True)
    assert 'Notes:             Jan 01 1970 00:02:00.000000000 UTC' in run('info', walk)[1]
    echoed = run('echo', walk, '/a')[1]
    before, after = echoed.split('# Jan 01 1970 00:02:00.000000000 UTC (120.000000000): rain began')
    assert before.count('data:') == 20
    assert after.count('data:') == 80
    assert run('echo', walk, '/a', '--csv')[0] == 0
    assert run('plot', walk, '/a', '-o', tmp_path / 'a.png')[0] == 0
    assert 'rain began' in run('list', walk)[1]
    assert run('cut', walk, tmp_path / 'wet', '--from', '10', '--to', '30')[0] == 0
    assert run('cut', walk, tmp_path / 'dry', '--from', '30')[0] == 0
    assert 'rain began' in run('info', tmp_path / 'wet')[1]
    assert 'rain began' not in run('info', tmp_path / 'dry')[1]
    assert run('recover', walk, tmp_path / 'saved')[0] == 0
    assert 'rain began' in run('info', tmp_path / 'saved')[1]


@pytest.mark.parametrize('arguments', [('x', '--at', '14:32'), ('x',), ('', '--at', '5')])
def test_a_note_elsewhere_or_of_nothing_is_refused(walk, arguments):
    status, out = run('note', walk, *arguments)
    assert status == 1
    assert 'reaches from' in out or 'expected 1 to' in out
    assert 'Notes' not in run('info', walk)[1]


def test_what_is_attached_is_listed_and_extracted_under_its_own_name_alone(walk, tmp_path):
    out = run('list', walk)[1]
    assert 'attachment ../calibration.yaml: text/yaml, 10 bytes' in out
    assert 'metadata site:\n  wood: spruce' in out
    assert run('list', walk, '--extract', tmp_path / 'files')[0] == 0
    assert (tmp_path / 'files' / 'calibration.yaml').read_bytes() == b'turret: 1\n'
    assert run('list', walk, '--extract', tmp_path / 'files')[0] == 1


def test_what_takes_the_space(walk):
    status, out = run('du', walk)
    assert status == 0
    assert '/a' in out
    assert '100.0 %' in out


def test_convert_there_and_back(walk, tmp_path):
    assert run('convert', walk, tmp_path / 'there')[0] == 0
    assert run('info', tmp_path / 'there')[0] == 0
    assert 'spruce' in run('list', tmp_path / 'there')[1]
    assert run('convert', tmp_path / 'there', tmp_path / 'back')[0] == 0
    assert len(edits.stamps(tmp_path / 'back')) == 100
    assert run('convert', walk, tmp_path / 'x', '--to', 'csv')[0] == 1
