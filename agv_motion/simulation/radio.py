"""Messages between trees as a bad network carries them: late, lost, and sometimes not at all."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, NamedTuple

from agv_motion.parameters import Spec, check

if TYPE_CHECKING:
    from agv_motion.motion.navigation.reservations.reservation import Reservation


@dataclass(frozen=True)
class RadioParameters:
    """How bad the network is."""

    loss: Annotated[float, Spec('share of messages lost', '1', (0.0, 1.0))] = 0.1
    delay: Annotated[float, Spec('longest time a message takes', 's', (0.0, 1e4))] = 2.0
    doubled: Annotated[float, Spec('share of messages that come twice', '1', (0.0, 1.0))] = 0.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class _Letter(NamedTuple):
    due: float
    receiver: str
    reservation: Reservation


class Radio:
    """Carries reservations between trees; each pair has luck of its own, so order may change."""

    def __init__(self, names: list[str], parameters: RadioParameters, seed: int) -> None:
        """Start with nothing on the way.

        Args:
            names: Of all trees.
            parameters: How bad it is.
            seed: Of all chance.

        """
        self._names, self.parameters = names, parameters
        self._random = random.Random(seed)  # noqa: S311 - a simulation, no secret
        self._letters: list[_Letter] = []
        self.deaf: set[tuple[str, str]] = set()
        """Pairs (sender, receiver) between which nothing passes."""

    def send(self, reservation: Reservation, now: float) -> None:
        """Send ``reservation`` to all others."""
        given = self.parameters
        for name in self._names:
            lost = (reservation.name, name) in self.deaf or self._random.random() < given.loss
            if name == reservation.name or lost:
                continue
            twice = given.doubled > 0.0 and self._random.random() < given.doubled
            for _ in range(1 + twice):
                due = now + self._random.uniform(0.0, given.delay)
                self._letters.append(_Letter(due, name, reservation))

    def receive(self, now: float) -> list[tuple[str, Reservation]]:
        """Return receiver and reservation of all that has come by ``now`` [s], earliest first."""
        arrived = sorted((letter for letter in self._letters if letter.due <= now), key=_due)
        self._letters = [letter for letter in self._letters if letter.due > now]
        return [(letter.receiver, letter.reservation) for letter in arrived]


def _due(letter: _Letter) -> float:
    return letter.due
