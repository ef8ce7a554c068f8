"""Launch a differential drive behind its Ghost, and a simulated robot unless there is a real one.

ros2 launch agv_motion differential.launch.py namespace:=hare
ros2 topic pub --once /hare/goal_pose geometry_msgs/msg/PoseStamped \
    '{header: {frame_id: map}, pose: {position: {x: 2.0, y: 1.0}}}'
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

SHARE = FindPackageShare('agv_motion')
DEFAULT_CONFIG = PathJoinSubstitution([SHARE, 'config', 'differential.yaml'])
ARGUMENTS = (
    ('namespace', '', 'name of this robot: its topics are /NAME/cmd_vel and so on'),
    ('config', DEFAULT_CONFIG, 'YAML file with the parameters of all nodes'),
    ('pose', 'fix', 'topic that tells where the robot is: fix, or pose of a localization'),
    ('simulate', 'true', 'whether to simulate the robot, its encoders and a camera over it'),
    ('use_sim_time', 'true', 'follow /clock: true with the simulator or a bag, else false'),
    ('time_factor', '1.0', 'simulated seconds per second'),
)


def generate_launch_description() -> LaunchDescription:
    """Return the nodes of one robot."""
    value = {name: LaunchConfiguration(name) for name, _, _ in ARGUMENTS}
    sim_time = {'use_sim_time': ParameterValue(value['use_sim_time'], value_type=bool)}

    def node(name, *parameters, **options):
        return Node(
            package='agv_motion',
            executable=name,
            name=name,
            namespace=value['namespace'],
            parameters=[value['config'], *parameters],
            output='screen',
            **options,
        )

    time_factor = ParameterValue(value['time_factor'], value_type=float)
    return LaunchDescription(
        [
            *(DeclareLaunchArgument(n, default_value=d, description=t) for n, d, t in ARGUMENTS),
            node('differential_kinematics', sim_time),
            node('ghost_trajectory', sim_time, remappings=[('pose', value['pose'])]),
            node(
                'differential_simulator',
                {'time_factor': time_factor},
                condition=IfCondition(value['simulate']),
            ),
        ]
    )
