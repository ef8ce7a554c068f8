"""A tree decides: where to go, by which path round a bench, how fast, and why, in words."""

from math import degrees, hypot

from agv_motion.motion.behavior import Agent, AgentParameters, SapFlow
from agv_motion.motion.command import to_twist
from agv_motion.motion.navigation import PathFollower, PathPlanner, Zone
from agv_motion.motion.pilot import Pilot
from agv_motion.planar import Pose

NOON = 1434367800.0  # seconds since 1970

zone = Zone(
    boundary=[(0, 0), (20, 0), (20, 15), (0, 15)],
    holes=[[(9, 6), (11, 6), (11, 12), (9, 12)]],  # the bench
    margin=0.5,
    rim=1.18,  # the platform turns as it goes, so its rim keeps the margin
)
planner = PathPlanner(zone)
agent = Agent(planner, AgentParameters(goal=(15.0, 8.0)))
pilot = Pilot(agent, PathFollower(planner))

for story, flow in (
    ('noon, sap flows', SapFlow(s1=0.8, s2=0.5, s3=0.4)),
    ('a cloud: it turns as it goes', SapFlow(s1=0.4, s2=0.75, s3=0.3)),
    ('night: the mean of the three is below 0.15', SapFlow(s1=0.1, s2=0.2, s3=0.05)),
):
    motion = pilot.update(NOON, Pose(5.0, 8.0, 0.0), flow, now=0.0)
    twist, wanted = to_twist(motion.wanted), motion.wanted
    speed = 60.0 * hypot(twist.vx, twist.vy)
    print(f'{story}: {motion.doing.state}')
    print(f'  {degrees(wanted.theta):.0f} deg, {speed:.2f} m/min, omega {wanted.omega:.1f}')
    if motion.path:
        print('  path', ' '.join(f'({x:.2f}, {y:.2f})' for x, y in motion.path))
