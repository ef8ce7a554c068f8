"""Launch an omni robot: arbiter, wheels, localization; it is simulated unless a real one is there.

ros2 launch agv_motion omni.launch.py namespace:=ant simulate:=false use_sim_time:=false
ros2 topic pub -r 10 /ant/cmd_vel/agent geometry_msgs/msg/TwistStamped '{twist: {linear: {x: 0.1}}}'
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import (
    EnvironmentVariable,
    LaunchConfiguration,
    PathJoinSubstitution,
)
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

DEFAULT_CONFIG = PathJoinSubstitution([FindPackageShare('agv_motion'), 'config', 'omni.yaml'])
STATE = [EnvironmentVariable('HOME', default_value='/var/lib'), '/.local/state/agv_motion']
ARGUMENTS = (
    ('namespace', '', 'name of this robot: its topics are /NAME/cmd_vel and so on'),
    ('config', DEFAULT_CONFIG, 'YAML file with the parameters of all nodes'),
    ('simulate', 'true', 'whether to simulate the robot, its encoders, gyroscope and UWB'),
    ('use_sim_time', 'true', 'follow /clock: true with the simulator or a bag, else false'),
    ('time_factor', '1.0', 'simulated seconds per second'),
    ('clock', 'lead', 'follow: another simulator tells the time, as of several robots all but one'),
    ('state', STATE, 'folder in which STOP and locks are kept over a restart'),
    ('respawn', 'false', 'start a node again 2 s after it ended by itself'),
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
            respawn=value['respawn'],
            respawn_delay=2.0,
            **options,
        )

    state_file = [value['state'], '/', value['namespace'], '/arbiter.json']
    state = {'state_file': ParameterValue(state_file, value_type=str)}
    time_factor = ParameterValue(value['time_factor'], value_type=float)
    return LaunchDescription(
        [
            *(DeclareLaunchArgument(n, default_value=d, description=t) for n, d, t in ARGUMENTS),
            node('arbiter', sim_time, state),
            node('why', sim_time),
            node('omni_kinematics', sim_time),
            node('localization', sim_time),
            node(
                'omni_simulator',
                {'time_factor': time_factor, 'clock': value['clock']},
                condition=IfCondition(value['simulate']),
            ),
        ]
    )
