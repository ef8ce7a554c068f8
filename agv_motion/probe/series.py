"""A whole series of readings of one probe in one call, as the live probe would have read them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import repeat
from math import nan
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.errors import SignalError
from agv_motion.probe.environment import UNKNOWN
from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.probe import Probe

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from agv_motion.probe.environment import Environment
    from agv_motion.probe.quality import Quality


@dataclass(frozen=True)
class ProbeSeries:
    """What is known of a probe at each of its readings; all columns of n values."""

    time: NDArray[np.float64]
    """[s] since 1970, UTC"""
    temperature_difference: NDArray[np.float64]
    """[K] dT as read; NaN where missing"""
    quality: tuple[Quality, ...]
    zero_flow: NDArray[np.float64]
    """[K] dT_max; NaN before the end of the first night"""
    flow_index: NDArray[np.float64]
    """[-] Granier's K; NaN where it cannot be known"""
    flux_density: NDArray[np.float64]
    """[m/s] NaN where it cannot be known"""
    sap_flow: NDArray[np.float64]
    """[-] in [0, 1]; NaN where it cannot be known"""


def read_series(
    time: ArrayLike,
    temperature_difference: ArrayLike,
    parameters: ProbeParameters | None = None,
    environment: Sequence[Environment] | None = None,
) -> ProbeSeries:
    """Return what one probe says of a series; causal: each reading is judged by those before it.

    Args:
        time: (n,) of the readings, not decreasing [s since 1970, UTC].
        temperature_difference: (n,) dT [K]; NaN where a reading is missing.
        parameters: How the probe is read.
        environment: The air at each of the readings.

    Raises:
        SignalError: The columns are not two of one length, or a time is not finite or decreases.

    """
    times, values = np.asarray(time, float), np.asarray(temperature_difference, float)
    if times.ndim != 1 or times.shape != values.shape:
        msg = f'time of shape {times.shape}, dT of shape {values.shape}: give two columns, as long'
        raise SignalError(msg)
    wrong = np.flatnonzero(~np.isfinite(times) | (np.diff(times, prepend=-np.inf) < 0.0))
    if len(wrong):
        row = int(wrong[0])
        msg = f'time {times[row]} s in row {row}: give finite times in their order'
        raise SignalError(msg)
    air = repeat(UNKNOWN, len(times)) if environment is None else environment
    if environment is not None and len(environment) != len(times):
        msg = f'{len(times)} readings, {len(environment)} rows of environment: give one for each'
        raise SignalError(msg)
    probe = Probe(parameters or ProbeParameters())
    rows = zip(times.tolist(), values.tolist(), air, strict=True)
    readings = [probe.update(*row) for row in rows]

    def column(name: str) -> NDArray[np.float64]:
        told = (getattr(reading, name) for reading in readings)
        return np.array([nan if value is None else value for value in told], float)

    return ProbeSeries(
        times,
        values,
        tuple(reading.quality for reading in readings),
        *map(column, ('zero_flow', 'flow_index', 'flux_density', 'sap_flow')),
    )
