"""The sap flow of the tree, and the rest that it asks for when it stands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.parameters import Spec, check


class SapFlow(NamedTuple):
    """Normalised sap flow of the three probes, each in [0, 1]."""

    s1: float
    """speed"""
    s2: float
    """rotation; 0.5 does not turn"""
    s3: float
    """what the tree remembers of places"""

    @property
    def rotation(self) -> float:
        """Omega of the tree, ``2 s2 - 1``."""
        return 2.0 * self.s2 - 1.0


@dataclass(frozen=True)
class RestParameters:
    """When the tree rests: its sap stands, though s2 = 0 alone would mean full rotation.

    The mean of the three decides: on three summers of a real spruce it lies below 0.15 for 98 % of
    the hours before dawn and above for 97 % of the afternoon; the highest of the three, for 83 %
    of those hours.
    """

    rest_below: Annotated[
        float, Spec('rest when the mean of the three is below', '1', (0.0, 1.0), dynamic=True)
    ] = 0.15
    wake_above: Annotated[
        float, Spec('move again when the mean is above', '1', (0.0, 1.0), dynamic=True)
    ] = 0.2
    arrival: Annotated[
        float, Spec('distance at which a goal is reached', 'm', (0.05, 100.0), dynamic=True)
    ] = 1.0

    def __post_init__(self) -> None:
        """Check every row, and that the tree does not wake below where it falls asleep."""
        check(self)
        if self.wake_above < self.rest_below:
            msg = (
                f'wake_above = {self.wake_above} is below rest_below = {self.rest_below}: '
                'the tree would fall asleep at once'
            )
            raise ConfigurationError(msg)


def checked_sap_flow(flow: SapFlow) -> SapFlow:
    """Return ``flow`` if each of its numbers lies in [0, 1].

    Raises:
        SignalError: One does not.

    """
    if 0.0 <= flow.s1 <= 1.0 and 0.0 <= flow.s2 <= 1.0 and 0.0 <= flow.s3 <= 1.0:
        return flow
    msg = f'sap flow {tuple(flow)} must be three numbers in [0, 1]: normalise it'
    raise SignalError(msg)


class Sleep:
    """Whether the tree rests: remembers that, so that it neither falls asleep nor wakes twice."""

    def __init__(self, parameters: RestParameters) -> None:
        """Start asleep."""
        self.parameters = parameters
        self.resting = True

    def update(self, flow: SapFlow) -> bool:
        """Return whether the tree rests with ``flow``."""
        mean = (flow.s1 + flow.s2 + flow.s3) / 3.0
        given = self.parameters
        self.resting = mean < (given.wake_above if self.resting else given.rest_below)
        return self.resting
