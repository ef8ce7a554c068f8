"""Launch the tree: probes, motion, arbiter, wheels, localization; its platform simulated if asked.

ros2 launch agv_motion tree.launch.py namespace:=oak source:=serial simulate:=false
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

DEFAULT_CONFIG = PathJoinSubstitution([FindPackageShare('agv_motion'), 'config', 'tree.yaml'])
STATE = [EnvironmentVariable('HOME', default_value='/var/lib'), '/.local/state/agv_motion']
ARGUMENTS = (
    ('namespace', '', 'name of this tree: its topics are /NAME/cmd_vel and so on'),
    ('config', DEFAULT_CONFIG, 'YAML file with the parameters of all nodes'),
    ('source', 'simulated', 'where the readings of the probes come from: simulated, csv, serial'),
    ('simulate', 'true', 'whether to simulate platform, localisation and sun'),
    ('use_sim_time', 'true', 'follow /clock: true with the simulator or a bag, else false'),
    ('time_factor', '1.0', 'simulated seconds per second'),
    ('clock', 'lead', 'follow: another simulator tells the time, as of several robots all but one'),
    ('state', STATE, 'folder in which STOP and locks are kept over a restart'),
    ('respawn', 'false', 'start a node again 2 s after it ended by itself'),
)


def generate_launch_description() -> LaunchDescription:
    """Return the nodes of one tree."""
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
            node('granier_probe', sim_time, {'source': value['source']}),
            node('motion_generator', sim_time, remappings=[('cmd_vel', 'cmd_vel/agent')]),
            node('arbiter', sim_time, state),
            node('why', sim_time),
            node('wheel_kinematics', sim_time),
            node('localization', sim_time),
            node(
                'simulator',
                {'time_factor': time_factor, 'clock': value['clock']},
                condition=IfCondition(value['simulate']),
            ),
        ]
    )
