"""What stands beside the messages of bags that become one: each once, and none lost."""

from __future__ import annotations

from mcap.writer import Writer

from agv_motion.bag.editing.edited_bags import extras
from agv_motion.bag.mcap.records import Attachment
from agv_motion.bag.reader import BagReader

PLAN = {'log_time': 1, 'create_time': 2, 'name': 'plan', 'media_type': 'text/plain', 'data': b'x'}


def bag(path, *attachments, names=()):
    """Write a bag by another's writer; return it, open."""
    with path.open('wb') as file:
        writer = Writer(file)
        writer.start('ros2')
        for attachment in attachments:
            writer.add_attachment(**attachment)
        for name in names:
            writer.add_metadata(name, {'site': 'square'})
        writer.finish()
    return BagReader(path)


def told(*bags):
    """Return attachments as they are, and the names of other strings."""
    found = [x if isinstance(x, Attachment) else x.name for x in extras(bags)]
    for one in bags:
        one.close()
    return found


def test_attachments_that_differ_in_anything_are_two(tmp_path):
    others = [
        PLAN | change
        for change in (
            {'log_time': 3}, {'create_time': 3}, {'name': 'map'}, {'media_type': 'text/csv'},
            {'data': b'y'},
        )
    ]  # fmt: skip
    found = told(bag(tmp_path / 'a.mcap', PLAN), bag(tmp_path / 'b.mcap', *others, PLAN))
    assert len(found) == 6
    assert len(set(found)) == 6


def test_what_several_bags_have_is_kept_as_often_as_one_of_them_has_it(tmp_path):
    once, twice = bag(tmp_path / 'a.mcap', PLAN), bag(tmp_path / 'b.mcap', PLAN, PLAN)
    assert len(told(once, twice)) == 2


def test_what_rosbag2_says_of_a_file_is_not_carried_over(tmp_path):
    both = [bag(tmp_path / f'{n}.mcap', names=('rosbag2', 'site')) for n in 'ab']
    assert told(*both) == ['site']
