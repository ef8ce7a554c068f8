"""What a fusion of odometry with position fixes has to be told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from agv_motion.parameters import Spec, check


@dataclass(frozen=True)
class FusionParameters:
    """When a fix is believed, when the robot is, and what to do about the rest."""

    horizon: Annotated[
        float, Spec('fixes that are later than this are refused', 's', (0.0, 60.0))
    ] = 1.5
    gate: Annotated[
        float, Spec('share of the sound fixes that pass the gate', '1', (0.5, 0.999999))
    ] = 0.999
    position_drift: Annotated[
        float, Spec('odometry and map part by this within 1 s, even at rest', 'm', (0.0, 1.0))
    ] = 0.001
    heading_drift: Annotated[
        float, Spec('odometry and map turn apart by this within 1 s', 'rad', (0.0, 1.0))
    ] = 0.0002
    heading_known: Annotated[
        float, Spec('standard deviation of a heading that is known', 'rad', (0.001, 0.5))
    ] = 0.2
    alignment_fixes: Annotated[
        int, Spec('fixes that must agree before the robot is found', '1', (2, 20))
    ] = 5
    search_time: Annotated[
        float, Spec('fixes older than this no longer help to find the robot', 's', (1.0, 1e5))
    ] = 300.0
    kidnap_fixes: Annotated[
        int, Spec('fixes in a row, at least, that agree but not with us: carried', '1', (3, 20))
    ] = 5
    kidnap_time: Annotated[float, Spec('and the time they span', 's', (0.0, 600.0))] = 10.0
    fix_timeout: Annotated[
        float, Spec('time without a fix after which odometry is alone', 's', (0.1, 3600.0))
    ] = 5.0
    max_speed: Annotated[
        float, Spec('of the robot; beyond, odometry began anew', 'm/s', (0.01, 100.0))
    ] = 10.0
    max_turn_rate: Annotated[
        float, Spec('of the robot; beyond, odometry began anew', 'rad/s', (0.01, 100.0))
    ] = 10.0
    tag_x: Annotated[
        float,
        Spec('where on the robot the fixes are taken, forward of base_link', 'm', (-100, 100)),
    ] = 0.0
    tag_y: Annotated[float, Spec('... and left of it', 'm', (-100, 100))] = 0.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)
