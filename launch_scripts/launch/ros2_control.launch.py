"""Launch ros2_control between wheel_kinematics and your drivers, for a tree on three turrets.

ros2 launch agv_motion ros2_control.launch.py      # beside tree.launch.py simulate:=false
"""

from launch import LaunchDescription
from launch_ros.actions import Node

from agv_motion.ros.config import find_config

CONTROLLERS = 'joint_state_broadcaster', 'steering', 'wheels'
REMAPPINGS = (
    ('steering/commands', 'turrets/steering_commands'),
    ('wheels/commands', 'turrets/wheel_commands'),
    ('joint_states', 'turrets/state'),
)
"""From the names of the controllers to those of wheel_kinematics"""


def generate_launch_description() -> LaunchDescription:
    """Return the controller manager, and what starts its controllers."""
    folder = find_config('tree.yaml').parent / 'ros2_control'
    controllers = str(folder / 'tree_controllers.yaml')
    description = (folder / 'tree_hardware.urdf').read_text(encoding='utf-8')
    manager = Node(
        package='controller_manager',
        executable='ros2_control_node',
        parameters=[{'robot_description': description}, controllers],
        remappings=list(REMAPPINGS),
        output='screen',
    )
    spawner = Node(
        package='controller_manager',
        executable='spawner',
        arguments=[*CONTROLLERS, '--param-file', controllers],
        output='screen',
    )
    return LaunchDescription([manager, spawner])
