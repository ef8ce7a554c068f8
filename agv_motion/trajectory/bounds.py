"""Numbers that can be meant: what is asked for lies in a range, and a ramp may be none."""

from __future__ import annotations

from agv_motion.errors import ConfigurationError

AT_ONCE = 1e300
"""[m/s2] The acceleration of whom nothing holds back: what its ramps take is below all rounding."""

NO_RAMP = 0.0
"""[m/s2], [rad/s2] In the place of an acceleration: the speed changes at once, nothing is ramped.

What the motors do of it is for the limits of the base to say."""

SPEEDS = (1e-9, 1e6)
"""[m/s], [rad/s] A speed beyond cannot be meant."""

RAMPS = (1e-9, AT_ONCE)
"""[m/s2], [rad/s2] Likewise a ramp."""


def require_between(
    name: str, value: float, between: tuple[float, float], unit: str, remedy: str = ''
) -> float:
    """Return ``value`` if it lies within the closed range ``between``.

    Raises:
        ConfigurationError: It does not, or is not a number; the message names value, range and
            ``remedy``.

    """
    low, high = between
    if not low <= value <= high:
        unit = unit and f' {unit}'
        wanted = f'must lie in [{low:g}, {high:g}]{unit}{remedy and f"; {remedy}"}'
        msg = f'{name} = {value}{unit}: {wanted}'
        raise ConfigurationError(msg)
    return value


def require_ramp(name: str, value: float, unit: str = 'm/s2') -> float:
    """Return the acceleration of a ramp: ``value``, or of `NO_RAMP` one without end.

    Raises:
        ConfigurationError: It is negative, not finite or too small.

    """
    if value == NO_RAMP:
        return AT_ONCE
    return require_between(name, value, RAMPS, unit, 'for no ramp give 0 (NO_RAMP)')
