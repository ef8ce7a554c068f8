"""What tells where the robot is: nobody, or odometry alone."""

from __future__ import annotations


def test_a_pose_that_is_not_told(robot):
    robot.rest('pose', 'resting: no pose', 'stopped')
    robot.localization = 2, 'pose not told: position or heading not known yet', {
        'state': 'searching', 'odom': 'fresh', 'pose told': 'no',
    }  # fmt: skip
    chain = robot.tell()
    assert chain.cause.name == 'pose'
    assert chain.headline.endswith(
        'set the pose (localization/set_pose), or let the robot drive a metre'
    )
    robot.localization = 2, 'odom is lost', robot.localization[2] | {'odom': 'lost'}
    assert robot.tell().headline.endswith('look at the encoders: odometry has ended')
