"""Actions one after another, from YAML: go to, rotate, arc, follow a route, wait.

`load_sequence` reads one, `SequenceRunner` runs it, a twist a cycle. What it will take:
:mod:`agv_motion.sequence.prediction`; its actions: :mod:`agv_motion.sequence.actions`.
"""

from agv_motion.sequence.runner import SequenceRunner
from agv_motion.sequence.sequence_file import load_sequence

__all__ = [
    'SequenceRunner',
    'load_sequence',
]
