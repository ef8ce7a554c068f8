"""Launch an omni robot: arbiter, wheels, localization; it is simulated unless a real one is there.

ros2 launch agv_motion omni.launch.py namespace:=ant simulate:=false use_sim_time:=false
ros2 topic pub -r 10 /ant/cmd_vel/agent geometry_msgs/msg/TwistStamped '{twist: {linear: {x: 0.1}}}'
"""

from launch import LaunchDescription

from agv_motion.ros.launch_description import described
from agv_motion.ros.robot_graphs import ROBOTS


def generate_launch_description() -> LaunchDescription:
    """Return the nodes of one robot, as `agv up omni` starts them."""
    return described(ROBOTS['omni'])
