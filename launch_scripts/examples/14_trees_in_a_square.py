"""Three trees share a square over a bad network: none ever comes too near to another.

A tree walks only on floor that it holds, and takes more only when all others have answered. So
late and lost messages cost time, and nothing else.
"""

from agv_motion.motion.navigation import Zone
from agv_motion.simulation.radio import RadioParameters
from agv_motion.simulation.trials.crowd import Crowd, CrowdParameters

square = Zone(boundary=[(0, 0), (20, 0), (20, 15), (0, 15)], rim=1.18)

for story, radio in (
    ('a good network', RadioParameters()),
    ('every third message is lost', RadioParameters(loss=0.3)),
):
    crowd = Crowd(square, CrowdParameters(trees=3, seed=1, radio=radio))
    crowd.run(1800.0)
    print(f'{story}: half an hour')
    for tree in crowd.walkers:
        x, y = tree.place
        print(f'  {tree.name} came to ({x:.1f}, {y:.1f}) and reached {tree.arrivals} goals')
    print(f'  the nearest two rims were {crowd.least_gap:.2f} m farther apart than they must be')
