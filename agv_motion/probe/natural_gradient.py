"""Natural gradient: sun and soil warm a stem unevenly, and its needles differ without any heating.

An unheated probe beside the heated ones shows by how much, and that is taken from each:
``dT = dT_heated - dT_unheated``. Source: F. Do and A. Rocheteau, "Influence of natural temperature
gradients on measurements of xylem sap flow with thermal dissipation probes", Tree Physiology 22,
2002.
"""

from __future__ import annotations

from math import nan

LARGEST = 5.0
"""[K] No stem differs by more over the ten centimetres between two needles."""


def without_natural_gradient(values: tuple[float, ...], reference: int) -> tuple[float, ...]:
    """Return the temperature differences [K] of heated probes without the natural gradient.

    Args:
        values: As read; NaN where there is none.
        reference: Which of them, from 0, is not heated; it stays as it is.

    Returns:
        NaN for all heated probes where the unheated one tells nothing that can be believed.

    """
    gradient = values[reference]
    if not abs(gradient) <= LARGEST:
        gradient = nan
    return tuple(value if i == reference else value - gradient for i, value in enumerate(values))
