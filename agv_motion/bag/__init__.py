"""Bags of ROS 2 without ROS: read them, also as columns of numbers, write, check, compare, save.

Read messages in the order of time, few at a time in memory; a folder of rosbag2, one MCAP file or
one sqlite3 file, whole or torn:

    with BagReader('walk') as bag:
        print(bag.topics, bag.start, bag.end)          # start and end in ns since 1970
        for message in bag.messages(['/odom'], start=bag.start + 10**9):
            print(message.stamp, message.connection.topic, len(message.data))

Read topics as numpy columns, some hundred times faster than message by message:

    with BagReader('walk') as bag:
        odom = read_topic(bag, '/odom', ['pose.pose.position', 'header.stamp'])
    plot(odom.seconds('header.stamp'), odom.fields['pose.pose.position.x'])

Write a bag as ``ros2 bag record`` leaves it:

    with BagWriter('new') as bag:
        topic = bag.add_topic('/cmd_vel', 'geometry_msgs/msg/TwistStamped')
        bag.write(topic, stamp, data)                  # ns since 1970, bytes in CDR

Look what is wrong in one, and save what can be read of it:

    with BagReader('walk') as bag:
        for finding in check(bag):
            print(finding.severity, finding.where, finding.text)
    with BagWriter('saved') as writer:
        Recovery(writer).save(Path('walk'))

Errors are :class:`agv_motion.errors.SourceError` (a file cannot be read, or is damaged: then a
`DamagedBagError` with file and byte) and :class:`agv_motion.errors.ConfigurationError` (an argument
is wrong). `README.md` beside this file tells the way through the rooms; whatever is not listed in
``__all__`` may change.
"""

from agv_motion.bag.checks.check import check
from agv_motion.bag.columns.column import Ragged, Texts
from agv_motion.bag.columns.columns import Columns, read_topic, read_topics
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter

__all__ = [
    'BagReader',
    'BagWriter',
    'Columns',
    'DamagedBagError',
    'OfferedQos',
    'Ragged',
    'Recovery',
    'Texts',
    'check',
    'read_topic',
    'read_topics',
]
