"""What draws the robots of a demo in RViz, Foxglove and the like, and what is recorded of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sensor_msgs.msg import JointState
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from agv_motion.demo.configured import configured_node
from agv_motion.demo.recorder import RecordedTopic
from agv_motion.nodes.robot_model import RobotModelNode
from agv_motion.nodes.scene import Scene

if TYPE_CHECKING:
    from agv_motion.ros.live_node import LiveNode

TOPICS = (
    RecordedTopic('robot_description', String, latched=True),
    RecordedTopic('joint_states', JointState),
    RecordedTopic('scene', MarkerArray, latched=True),
)
"""Of each robot; /tf and /tf_static follow from them, its odometry and its pose"""


def scene_node(file: str, namespace: str = '', *remapped: str) -> LiveNode[Scene]:
    """Return a node `scene` with its values in ``file`` of config/.

    Args:
        file: Of the configuration.
        namespace: Of the robot; empty for none.
        remapped: Topics, as ``pose:=fix``.

    """
    more = {'namespace': namespace} if namespace else {}
    words = [word for one in remapped for word in ('-r', one)]
    arguments = ['--ros-args', *words] if words else []
    return configured_node(Scene, file, {'use_sim_time': True}, cli_args=arguments, **more)


def model_node(file: str, namespace: str = '', pose: str = 'pose') -> LiveNode[RobotModelNode]:
    """Return a node `robot_model` with its values in ``file`` of config/.

    Args:
        file: Of the configuration.
        namespace: Of the robot; empty for none.
        pose: Topic that tells where the robot is.

    """
    more = {'namespace': namespace} if namespace else {}
    remapped = ['--ros-args', '-r', f'pose:={pose}']
    return configured_node(RobotModelNode, file, {'use_sim_time': True}, cli_args=remapped, **more)
