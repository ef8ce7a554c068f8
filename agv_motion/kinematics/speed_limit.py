"""A limit of wheel speed that limits something."""

from __future__ import annotations

from agv_motion.errors import ConfigurationError


def require_wheel_speed(limit: float) -> None:
    """Raise unless ``limit`` [m/s] lets a wheel roll, as far as numbers go.

    Raises:
        ConfigurationError: It is NaN, zero or below: such a limit turns wheels round, or holds
            nothing.

    """
    if not limit > 0.0:  # also true when NaN
        msg = f'max_wheel_speed = {limit} m/s: must be above 0; who shall stand gets a zero twist'
        raise ConfigurationError(msg)
