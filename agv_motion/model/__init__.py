"""What a robot is made of, the frames of its parts, and where they are: for all tools that draw."""

from agv_motion.model.graph_transforms import GraphTransforms
from agv_motion.model.urdf_reading import read_urdf

__all__ = [
    'GraphTransforms',
    'read_urdf',
]
