"""Actions one after another, and what an ideal robot would make of them before anything moves."""

from math import degrees
from pathlib import Path
from tempfile import TemporaryDirectory

from agv_motion.planar import Pose
from agv_motion.route import FollowParameters
from agv_motion.sequence import load_sequence
from agv_motion.sequence.prediction import predict
from agv_motion.trajectory import GhostParameters

TEXT = """
name: round trip
actions:
  - go_to: {x: 2.0, y: 0.0, speed: 0.4, acceleration: 0.4}
  - rotate: {by: 90, speed: 45, acceleration: 90}
  - wait: 2
  - arc: {angle: 180, diameter: 0.6, speed: 0.3, acceleration: 0.3}
    timeout: 5
"""

with TemporaryDirectory() as folder:
    file = Path(folder) / 'sequence.yaml'
    file.write_text(TEXT, encoding='utf-8')
    sequence = load_sequence(file)

for predicted in predict(sequence, Pose(0.0, 0.0, 0.0), GhostParameters(), FollowParameters()):
    end = predicted.end
    print(
        f'{predicted.begin:5.2f} s  {predicted.step.name}: {predicted.duration:.2f} s to '
        f'({end.x:.2f}, {end.y:.2f}), {degrees(end.theta):.0f} deg'
    )
    if predicted.warning:
        print('  beware:', predicted.warning.partition(': ')[2])
