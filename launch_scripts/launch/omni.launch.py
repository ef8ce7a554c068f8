r"""Launch an omni robot: arbiter, wheels, localization; it is simulated unless a real one is there.

ros2 launch agv_motion omni.launch.py namespace:=ant simulate:=false use_sim_time:=false
ros2 topic pub --once /ant/initialpose geometry_msgs/msg/PoseWithCovarianceStamped \
    '{header: {frame_id: map}, pose: {pose: {position: {x: 2.0, y: 2.0}, orientation: {w: 1.0}}}}'
ros2 topic pub --once /ant/goal_pose geometry_msgs/msg/PoseStamped \
    '{header: {frame_id: map}, pose: {position: {x: 3.0, y: 2.0}}}'
"""

from launch import LaunchDescription

from agv_motion.ros.launch_description import described
from agv_motion.ros.robot_graphs import ROBOTS


def generate_launch_description() -> LaunchDescription:
    """Return the nodes of one robot, as `agv up omni` starts them."""
    return described(ROBOTS['omni'])
