"""Fusion: odometry that runs ahead, coarse position fixes, and one of them far off.

The robot drives along x at 0.5 m/s; its wheels are 2 % smaller than drawn. Twice a second a fix of
10 cm tells where it is; the one at 20 s is 5 m off.
"""

import numpy as np

from agv_motion.odometry import Covariance, PoseFusion, position_fix
from agv_motion.planar import Pose

noise = np.random.default_rng(1)
fusion = PoseFusion()

for k in range(801):
    time, x = 0.05 * k, 0.5 * 0.05 * k
    drawn = 1.02 * x
    sure = (0.02 * x) ** 2 + 1e-6  # [m2] how far the wheels can be trusted
    fusion.add_odometry(time, Pose(drawn, 0.0, 0.0), Covariance(sure, 0, 0, sure, 0, 1e-6))
    if k % 10 == 0:
        seen = noise.normal((x, 5.0 if k == 400 else 0.0), 0.1)
        verdict = fusion.add_fix(position_fix(time, *seen, deviation=0.1))
    if k and k % 200 == 0:
        off = fusion.estimate().pose.x - x
        print(f'{time:.0f} s: odometry {100 * (drawn - x):.0f} cm off, fusion {100 * off:.1f} cm')
        print(f'  last fix: {verdict.value}; {fusion.health().state.value}')
