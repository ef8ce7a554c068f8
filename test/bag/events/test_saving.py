"""Files of recordings: their order, what is deleted of them, and names that are taken."""

from __future__ import annotations

import pytest

from agv_motion.bag.events.event import Event, Moment
from agv_motion.bag.events.saving import delete_recording, last_stamp, recording_files, save_torn
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic
from agv_motion.bag.reader import BagReader


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


def test_a_file_without_a_number_stands_first(tmp_path):
    for name in ('walk_0', 'walk_1', 'walk', 'walk_2x'):
        (tmp_path / f'{name}.mcap').touch()
    first, second, *others = [path.stem for path in recording_files(tmp_path)]
    assert ({first, second}, others) == ({'walk', 'walk_2x'}, ['walk_0', 'walk_1'])


@pytest.fixture
def walk(tmp_path):
    """Files from 10 to 30, of nothing, and from 50 to 70."""
    files = []
    for number, stamps in enumerate(((10, 30), (), (50, 70))):
        writer = McapWriter(tmp_path / f'walk_{number}.mcap', '')
        writer.add_topic(Topic('/a', 'a/msg/A', 'int8 x', '', ()))
        for stamp in stamps:
            writer.write(1, stamp, b'\0\1\0\0\5', stamp, 0)
        writer.flush()
        writer.close({})
        files.append(writer.path)
    return files


def test_the_last_stamp_is_that_of_any_file(walk):
    assert (last_stamp(walk), last_stamp(walk[::-1]), last_stamp(walk[:2])) == (70, 70, 30)


@pytest.mark.parametrize(('begin', 'end', 'stamps'), [
    (30, 50, [30, 50]), (31, 49, None), (31, 50, [50]), (30, 49, [30]), (0, 9, None),
    (71, 99, None),
    (0, 10, [10]), (70, 99, [70]), (0, 99, [10, 30, 50, 70]),
])  # fmt: skip
def test_an_event_has_what_was_recorded_from_its_begin_to_its_end(
    walk, tmp_path, begin, end, stamps
):
    """Both within it; a second bag of the same name has a number, and a third the next."""
    event, folder = Event((Moment(end, 'slip'),), begin, end), tmp_path / 'events'
    folder.mkdir()
    made = [save_torn(event, walk, folder) for _ in range(3 if stamps == [10] else 1)]
    if stamps is None:
        assert made == [None]
        return
    with BagReader(made[0]) as bag:
        assert [message.stamp for message in bag.messages()] == stamps
    name = 'event_1970_01_01-00_00_00Z_slip'
    assert [path.name for path in made] == [name, f'{name}_2', f'{name}_3'][: len(made)]
    assert not list(folder.glob('.*'))
