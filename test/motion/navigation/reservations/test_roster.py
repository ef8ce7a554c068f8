"""Names of other trees over a restart: kept before they are needed, never wrong."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.motion.navigation.reservations.roster import Roster


def test_names_are_there_again_and_none_twice(tmp_path):
    path = tmp_path / 'new' / 'peers'
    roster = Roster(str(path))
    assert roster.names == []
    for name in ('ash', 'pine', 'ash'):
        roster.add(name)
    assert Roster(str(path)).names == ['ash', 'pine']


def test_without_a_file_they_are_kept_as_long_as_the_run():
    roster = Roster('')
    roster.add('ash')
    assert roster.names == ['ash']
    assert Roster('').names == []


def test_a_person_may_write_the_file(tmp_path):
    path = tmp_path / 'peers'
    path.write_text('["ash", "pine"]')
    assert Roster(str(path)).names == ['ash', 'pine']


def test_no_flipped_bit_passes_for_another_name(tmp_path):
    path = tmp_path / 'peers'
    Roster(str(path)).add('ash')
    sound = path.read_bytes()
    for bit in range(8 * len(sound)):
        damaged = bytearray(sound)
        damaged[bit // 8] ^= 1 << bit % 8
        path.write_bytes(damaged)
        roster = Roster(str(path))
        assert (roster.names, 'set aside' in roster.complaint) == ([], True)
        for aside in tmp_path.glob('peers.unusable*'):
            aside.unlink()


@pytest.mark.parametrize('text', ['{}', '[1]', '[""]', '[' * 100_000, '"ash"', '["' + 'x' * 201])
def test_what_is_no_list_of_names_is_set_aside(tmp_path, text):
    path = tmp_path / 'peers'
    path.write_text(text)
    assert 'set aside as peers.unusable' in Roster(str(path)).complaint


def test_a_folder_is_refused_and_a_disk_that_takes_nothing_is_told(tmp_path):
    with pytest.raises(ConfigurationError, match='is a folder'):
        Roster(str(tmp_path))
    (tmp_path / 'file').write_text('')
    roster = Roster(str(tmp_path / 'file' / 'peers'))
    with pytest.raises(ConfigurationError, match="cannot keep the name 'ash'"):
        roster.add('ash')
    assert roster.names == ['ash']
