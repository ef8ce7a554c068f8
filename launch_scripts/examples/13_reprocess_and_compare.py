"""What would the nodes have decided with another value? Run them over a bag, twice, and compare.

The bag holds five seconds of `cmd_vel`. A wheel drawn 5 % too small has to turn 5 % faster.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

from geometry_msgs.msg import TwistStamped

from agv_motion.bag import BagReader, BagWriter
from agv_motion.bag.editing.diff import Tolerance, diff
from agv_motion.reprocess import Plan, reprocess
from agv_motion.ros.cdr import codec

SECOND = 1_000_000_000

with TemporaryDirectory() as name:
    folder = Path(name)
    with BagWriter(folder / 'drive') as bag:
        topic, message = bag.add_topic('/cmd_vel', 'geometry_msgs/msg/TwistStamped'), TwistStamped()
        message.twist.linear.x = 0.2
        for stamp in range(1000 * SECOND, 1005 * SECOND, SECOND // 10):
            message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
            bag.write(topic, stamp, codec(TwistStamped).encode(message))
    for radius in (0.05, 0.0475):
        config = folder / f'{radius}.yaml'
        values = f'wheel_radii: [{radius}, {radius}]'
        config.write_text(f'differential_kinematics: {{ros__parameters: {{{values}}}}}')
        plan = Plan(str(config), ('differential_kinematics',), (), 'zstd')
        outcome = reprocess(folder / 'drive', folder / f'with_{radius}', plan)
        print(f'{radius} m: {outcome.messages_in} messages in; {outcome.failure or "done"}')
    with BagReader(folder / 'with_0.05') as first, BagReader(folder / 'with_0.0475') as second:
        for found in diff(first, second, ['/wheels/command'], Tolerance()):
            print(f'{found.topic}: {found.differing} of {found.compared} pairs differ')
            for worst in found.worst.values():
                print(f'  {worst.path}: {worst.first:.3f} and {worst.second:.3f} rad/s at most')
