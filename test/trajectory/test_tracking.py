"""Laws of control as laws: exact on the trajectory, and their Lyapunov functions never grow."""

from __future__ import annotations

from math import cos, inf, nan, pi, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.planar import Pose, Twist, compose, integrate, wrap
from agv_motion.trajectory.holonomic import Holonomic, HolonomicGains
from agv_motion.trajectory.kanayama import Kanayama, KanayamaGains
from agv_motion.trajectory.motion import STILL, Speeds
from agv_motion.trajectory.ramsete import Ramsete, RamseteGains
from agv_motion.trajectory.tracking import TrackingError, tracking_error

ANGLES = st.floats(-pi, pi, exclude_max=True)
POSES = st.builds(Pose, st.floats(-4.0, 4.0), st.floats(-4.0, 4.0), ANGLES)
ERRORS = st.builds(TrackingError, st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), ANGLES)
SPEEDS = st.builds(Speeds, st.floats(-2.0, 2.0), st.floats(-3.0, 3.0))
LAWS = st.one_of(
    st.builds(
        lambda *gains: Kanayama(KanayamaGains(*gains)),
        st.floats(0.1, 20.0), st.floats(0.1, 100.0), st.floats(0.1, 50.0), st.floats(0.0, 10.0),
    ),
    st.builds(
        lambda *gains: Ramsete(RamseteGains(*gains)),
        st.floats(0.1, 100.0), st.floats(0.05, 0.95), st.floats(0.01, 20.0),
    ),
    st.builds(
        lambda p, h: Holonomic(HolonomicGains(p, h)), st.floats(0.1, 20.0), st.floats(0.1, 20.0)
    ),
)  # fmt: skip
EACH = pytest.mark.parametrize('law', [Kanayama(), Ramsete(), Holonomic()])


@given(POSES, POSES)
def test_the_error_is_the_ghost_seen_from_the_robot(ghost, robot):
    error = tracking_error(ghost, robot)
    there = compose(robot, Pose(*error))
    assert there[:2] == pytest.approx(ghost[:2], abs=1e-12)
    assert abs(wrap(there.theta - ghost.theta)) < 1e-12


@given(LAWS, SPEEDS)
def test_on_the_trajectory_it_drives_what_the_ghost_drives(law, speeds):
    twist = law.twist(TrackingError(0.0, 0.0, 0.0), speeds)
    assert twist == pytest.approx((speeds.linear, 0.0, speeds.angular), abs=1e-15)
    assert law.lyapunov(TrackingError(0.0, 0.0, 0.0)) == 0.0


@given(LAWS, ERRORS, SPEEDS)
def test_the_lyapunov_function_never_grows(law, error, speeds):
    """By the error dynamics, equation (1) of `tracking`, in a difference quotient."""
    vx, vy, wz = law.twist(error, speeds)
    x, y, theta = error
    rates = (
        wz * y - vx + speeds.linear * cos(theta),
        -wz * x - vy + speeds.linear * sin(theta),
        speeds.angular - wz,
    )
    if not -pi + 1e-3 < theta < pi - 1e-3:
        return  # beside the jump of the angle there is no derivative

    def after(h):
        return law.lyapunov(TrackingError(*(e + h * r for e, r in zip(error, rates, strict=True))))

    h = 1e-6
    slope = (after(h) - after(-h)) / (2.0 * h)
    assert slope <= 1e-4 * (1.0 + sum(rate * rate for rate in rates))


@EACH
@settings(max_examples=20)
@given(error=ERRORS, backward=st.booleans())
def test_a_robot_beside_the_trajectory_comes_back_to_it(law, error, backward):
    """A circle of 1 m radius, forwards or backwards, with no disturbance: all errors vanish."""
    speeds, dt = Speeds(-0.5 if backward else 0.5, 0.5), 0.02
    if abs(error.heading) > 2.8:
        return  # looking the other way is an equilibrium too, though not a stable one
    ghost = Pose(0.0, 0.0, 0.0)
    robot = compose(ghost, Pose(-error.along, -error.across, -error.heading))
    for _ in range(1500):
        robot = integrate(robot, law.twist(tracking_error(ghost, robot), speeds), dt)
        ghost = integrate(ghost, Twist(speeds.linear, 0.0, speeds.angular), dt)
    assert law.lyapunov(tracking_error(ghost, robot)) < 1e-4


def test_a_robot_that_can_go_sideways_closes_every_error_at_rest():
    """After 1 s with a gain of 4 1/s, e^-4 of each error is left."""
    law, robot, ghost = Holonomic(), Pose(0.3, -0.2, 0.0), Pose(0.0, 0.0, 0.0)
    for _ in range(10000):
        robot = integrate(robot, law.twist(tracking_error(ghost, robot), STILL), 1e-4)
    assert robot[:2] == pytest.approx((0.3 * 0.0183156, -0.2 * 0.0183156), rel=1e-3)


def test_ramsete_comes_up_to_a_ghost_that_stands():
    """Gain 2 1/s at rest: 0.2 m along ask for 0.4 m/s, 0.1 rad for 0.2 rad/s."""
    twist = Ramsete().twist(TrackingError(0.2, 0.3, 0.1), STILL)
    assert twist == pytest.approx((0.4, 0.0, 0.2))


def test_kanayama_turning_on_the_spot_minds_the_heading():
    twist = Kanayama().twist(TrackingError(0.0, 0.0, 0.1), Speeds(0.0, 0.5))
    assert twist.wz > 0.5
    assert Kanayama().gains.damping == 1.0


@pytest.mark.parametrize(
    ('kind', 'name'),
    [
        (KanayamaGains, 'along'), (KanayamaGains, 'across'), (KanayamaGains, 'heading'),
        (RamseteGains, 'b'), (RamseteGains, 'zeta'), (RamseteGains, 'at_rest'),
        (HolonomicGains, 'position'), (HolonomicGains, 'heading'),
    ],
)  # fmt: skip
def test_gains_outside_the_condition_of_the_paper_are_refused(kind, name):
    for bad in (0.0, -1.0, nan, inf):
        with pytest.raises(ConfigurationError, match=name):
            pytest.fail(f'{bad} is taken: {kind(**{name: bad})}')


@pytest.mark.parametrize('zeta', [1.0, 1.5])
def test_too_much_damping_is_refused(zeta):
    with pytest.raises(ConfigurationError, match='zeta'):
        RamseteGains(zeta=zeta)
