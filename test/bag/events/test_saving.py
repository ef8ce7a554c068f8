"""Files of recordings: their order, what is deleted of them, and names that are taken."""

from __future__ import annotations

from agv_motion.bag.events.event import Event, Moment
from agv_motion.bag.events.saving import delete_recording, last_stamp, recording_files, save_torn


def test_files_stand_in_the_order_in_which_they_were_written(tmp_path):
    for number in (10, 9, 0):
        (tmp_path / f'walk_{number}.mcap').touch()
    assert [path.stem for path in recording_files(tmp_path)] == ['walk_0', 'walk_9', 'walk_10']


def test_only_what_a_recorder_wrote_is_deleted(tmp_path):
    folder = tmp_path / 'walk'
    folder.mkdir()
    for name in ('walk_0.mcap', 'metadata.yaml', 'mine.txt'):
        (folder / name).touch()
    delete_recording(folder)
    assert [path.name for path in folder.iterdir()] == ['mine.txt']
    (folder / 'mine.txt').unlink()
    delete_recording(folder)
    assert not folder.exists()
    delete_recording(folder)


def test_files_into_which_nothing_was_written_have_no_event(tmp_path):
    (tmp_path / 'walk_0.mcap').touch()
    files = recording_files(tmp_path)
    assert last_stamp(files) == 0
    assert save_torn(Event((Moment(5, 'slip'),), 0, 9), files, tmp_path / 'events') is None
