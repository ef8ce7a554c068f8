"""Launch the tree: probes, motion, arbiter, wheels, localization; its platform simulated if asked.

ros2 launch agv_motion tree.launch.py namespace:=oak source:=serial simulate:=false
"""

from launch import LaunchDescription

from agv_motion.ros.launch_description import described
from agv_motion.ros.robot_graphs import ROBOTS


def generate_launch_description() -> LaunchDescription:
    """Return the nodes of one robot, as `agv up tree` starts them."""
    return described(ROBOTS['tree'])
