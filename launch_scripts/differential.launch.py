"""Launch a differential drive: Ghost, routes, sequences; a robot is simulated unless one is real.

ros2 launch agv_motion differential.launch.py namespace:=hare
ros2 topic pub --once /hare/goal_pose geometry_msgs/msg/PoseStamped \
    '{header: {frame_id: map}, pose: {position: {x: 2.0, y: 1.0}}}'
ros2 launch agv_motion differential.launch.py sequence:=sequence_example.yaml
ros2 service call /sequence/start std_srvs/srv/Trigger
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

SHARE = FindPackageShare('agv_motion')
DEFAULT_CONFIG = PathJoinSubstitution([SHARE, 'config', 'differential.yaml'])
STATE = [EnvironmentVariable('HOME', default_value='/var/lib'), '/.local/state/agv_motion']
ARGUMENTS = (
    ('namespace', '', 'name of this robot: its topics are /NAME/cmd_vel and so on'),
    ('config', DEFAULT_CONFIG, 'YAML file with the parameters of all nodes'),
    ('pose', 'fix', 'topic that tells where the robot is: fix, or pose of a localization'),
    ('route', '', 'file of a route to follow at once; empty: one may come on the topic route'),
    ('sequence', '', 'file of a sequence of actions, for the service sequence/start'),
    ('simulate', 'true', 'whether to simulate the robot, its encoders and a camera over it'),
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
    drivers = {
        'ghost_trajectory': ('page', []),
        'route_follower': ('route', [{'route_file': value['route']}]),
        'sequence': ('sequence', [{'file': value['sequence']}]),
    }  # each is silent until it is asked to drive: by a goal, a route, or ~/start

    def remapped(source):
        return [('pose', value['pose']), ('cmd_vel', f'cmd_vel/{source}')]

    return LaunchDescription(
        [
            *(DeclareLaunchArgument(n, default_value=d, description=t) for n, d, t in ARGUMENTS),
            node('differential_kinematics', sim_time),
            node('arbiter', sim_time, state),
            node('why', sim_time),
            *(
                node(driver, sim_time, *own, remappings=remapped(source))
                for driver, (source, own) in drivers.items()
            ),
            node(
                'differential_simulator',
                {'time_factor': time_factor, 'clock': value['clock']},
                condition=IfCondition(value['simulate']),
            ),
        ]
    )
