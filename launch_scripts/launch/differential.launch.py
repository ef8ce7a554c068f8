"""Launch a differential drive: Ghost, routes, sequences; a robot is simulated unless one is real.

ros2 launch agv_motion differential.launch.py namespace:=hare
ros2 topic pub --once /hare/goal_pose geometry_msgs/msg/PoseStamped \
    '{header: {frame_id: map}, pose: {position: {x: 2.0, y: 1.0}}}'
ros2 launch agv_motion differential.launch.py sequence:=sequence_example.yaml
ros2 service call /sequence/start std_srvs/srv/Trigger
"""

from launch import LaunchDescription

from agv_motion.ros.launch_description import described
from agv_motion.ros.robot_graphs import ROBOTS


def generate_launch_description() -> LaunchDescription:
    """Return the nodes of one robot, as `agv up differential` starts them."""
    return described(ROBOTS['differential'])
