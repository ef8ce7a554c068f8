"""STOP and locks on disk: the same after a restart; in doubt, STOP."""

from __future__ import annotations

import json

import pytest

from agv_motion import saved_state
from agv_motion.arbitration import TwistSource
from agv_motion.arbitration.choice import FREE, HeldStop, Hold
from agv_motion.arbitration.hold_file import LARGEST, LONGEST, restore, save
from agv_motion.errors import ConfigurationError

HELD = Hold(
    HeldStop('somebody fell', 12.5),
    frozenset({TwistSource.MANUAL}),
    frozenset({TwistSource.MANUAL}),
)


@pytest.mark.parametrize(
    'hold', [HELD, FREE, Hold(locks=frozenset(TwistSource) - {TwistSource.STOP})]
)
def test_what_was_held_is_held(tmp_path, hold):
    path = tmp_path / 'deep' / 'arbiter.json'
    save(path, hold)
    assert restore(path, 99.0) == (hold, '')


def test_without_a_file_nothing_is_held(tmp_path):
    assert restore(tmp_path / 'none', 99.0) == (FREE, '')


def test_a_long_reason_is_cut_so_that_the_file_can_be_read(tmp_path):
    save(tmp_path / 'a', Hold(HeldStop('é' * LARGEST, 0.0)))
    assert restore(tmp_path / 'a', 99.0)[0].stop == HeldStop('é' * LONGEST, 0.0)


DAMAGED = {
    'empty': b'',
    'no JSON': b'{',
    'no object': b'[]',
    'another version': b'{"version": 2}',
    'lacks': b'{"version": 1, "stop": null, "locks": []}',
    'unknown source': b'{"version": 1, "stop": null, "locks": ["me"], "lost": []}',
    'a number for a list': b'{"version": 1, "stop": null, "locks": 3, "lost": []}',
    'stop of another kind': b'{"version": 1, "stop": true, "locks": [], "lost": []}',
    'no reason': b'{"version": 1, "stop": {"reason": 1, "since": 2}, "locks": [], "lost": []}',
    'NaN': b'{"version": 1, "stop": {"reason": "", "since": NaN}, "locks": [], "lost": []}',
    'no text': b'\xff\xfe',
    'large': b' ' * (LARGEST + 1),
}


@pytest.mark.parametrize('case', DAMAGED)
@pytest.mark.parametrize('sealed', [True, False])
def test_in_doubt_it_is_stopped(tmp_path, case, sealed):
    path = tmp_path / 'arbiter.json'
    if sealed:
        saved_state.save(path, DAMAGED[case])
    else:
        path.write_bytes(DAMAGED[case])
    hold, told = restore(path, 99.0)
    assert hold.stop.since == 99.0
    assert 'could not be used' in hold.stop.reason
    assert 'set aside as arbiter.json.unusable' in told
    assert not path.exists()


def test_a_flipped_bit_is_found(tmp_path):
    path = tmp_path / 'arbiter.json'
    save(path, FREE)
    content = path.read_bytes()
    path.write_bytes(content.replace(b'null', b'nulk'))
    assert restore(path, 1.0)[0].stop is not None


@pytest.mark.parametrize('make', ['folder', 'link'])
def test_what_is_no_place_for_a_file_is_refused(tmp_path, make):
    path = tmp_path / 'arbiter.json'
    path.symlink_to('/dev/null') if make == 'link' else path.mkdir()
    with pytest.raises(ConfigurationError, match=r'folder|link'):
        restore(path, 1.0)


def test_a_file_is_plain_json_behind_its_first_line(tmp_path):
    save(tmp_path / 'a', HELD)
    assert json.loads((tmp_path / 'a').read_bytes().partition(b'\n')[2]) == {
        'version': 1, 'stop': {'reason': 'somebody fell', 'since': 12.5}, 'locks': ['manual'],
        'lost': ['manual'],
    }  # fmt: skip
