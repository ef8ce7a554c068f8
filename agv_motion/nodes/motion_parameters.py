"""Parameters of `motion_generator`, those of all that it moves by among them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Annotated

from agv_motion.blocked import SlowlyBlockedParameters
from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.platform import PlatformOutline
from agv_motion.motion.behavior.goals.strategies import GoalParameters
from agv_motion.motion.behavior.homing import HomeParameters
from agv_motion.motion.behavior.memory import MemoryParameters
from agv_motion.motion.behavior.parameters import AgentParameters
from agv_motion.motion.behavior.sap_flow import RestParameters
from agv_motion.motion.behavior.schedule import ScheduleParameters
from agv_motion.motion.command.limits import LimitParameters
from agv_motion.motion.command.polar import LINEAR_SPEED
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.motion.navigation.zone_text import zone_of_text
from agv_motion.nodes.input_parameters import CommandParameters
from agv_motion.parameters import Spec
from agv_motion.ros.config import find_config


@dataclass(frozen=True)
class MotionGeneratorParameters(CommandParameters, PlatformOutline):
    """How sap flow becomes motion."""

    rate: Annotated[float, Spec('commands per second', 'Hz', (0.1, 1000.0))] = 10.0
    linear_speed: Annotated[
        float, Spec("the trunk's speed at full sap flow", 'm/s', (1e-4, 10.0))
    ] = LINEAR_SPEED
    goal: Annotated[
        tuple[float, ...],
        Spec('where to go with the strategy fixed, x and y in the map; RViz may set another', 'm'),
    ] = (10.0, 7.5)
    report_after: float = 3.0
    stop_after: float = 5.0
    max_age: float = 5.0
    map_frame: Annotated[str, Spec('frame of pose and goal')] = 'map'
    zone_file: Annotated[
        str, Spec('zone that is never left: a path, or a file of config/; empty: anywhere')
    ] = ''
    zone: Annotated[
        str,
        Spec(
            'zone as text, YAML or JSON with the keys of a zone file; empty: as zone_file says',
            dynamic=True,
        ),
    ] = ''
    rest_until: Annotated[
        float,
        Spec(
            'rest until then, whatever flows, seconds since 1970; 0: do not',
            's',
            (0.0, 1e11),
            dynamic=True,
        ),
    ] = 0.0
    memory_file: Annotated[
        str, Spec('where to keep the memory of places over a restart; empty: nowhere')
    ] = ''
    share_zone: Annotated[
        bool,
        Spec(
            'other trees walk here: tell them the path on /reservations, and keep clear of theirs'
        ),
    ] = False
    tree_name: Annotated[
        str, Spec('by which the other trees know this one; empty: its namespace')
    ] = ''
    peers_file: Annotated[
        str,
        Spec('where to keep the names of the other trees over a restart; empty: nowhere'),
    ] = ''
    map_period: Annotated[
        float, Spec('time between two publications of the memory maps', 's', (0.1, 3600.0))
    ] = 5.0
    last_visit_span: Annotated[
        float,
        Spec('time since a visit that memory/last_visit shows as 100', 'h', (0.01, 1e5)),
    ] = 100.0
    blocked: SlowlyBlockedParameters = field(default_factory=SlowlyBlockedParameters)
    rest: RestParameters = field(default_factory=RestParameters)
    goals: GoalParameters = field(default_factory=GoalParameters)
    memory: MemoryParameters = field(default_factory=MemoryParameters)
    limits: LimitParameters = field(default_factory=LimitParameters)
    schedule: ScheduleParameters = field(default_factory=ScheduleParameters)
    home: HomeParameters = field(default_factory=HomeParameters)
    traffic: TrafficParameters = field(default_factory=TrafficParameters)

    def __post_init__(self) -> None:
        """Check every row, and that the goal is a point."""
        super().__post_init__()
        if len(self.goal) != 2:
            msg = f'goal = {list(self.goal)}: give x and y in metres'
            raise ConfigurationError(msg)

    def agent(self) -> AgentParameters:
        """Return what the agent needs of these."""
        return AgentParameters(
            goals=self.goals,
            memory=self.memory,
            rest=self.rest,
            schedule=self.schedule,
            home=self.home,
            rest_until=self.rest_until,
            goal=(self.goal[0], self.goal[1]),
            linear_speed=self.linear_speed,
            platform_radius=self.rim,
        )

    def planner(self, home: tuple[float, float] | None = None) -> PathPlanner | None:
        """Return the paths in the zone that the parameters tell; None: there is none.

        Args:
            home: Where the tree is parked if a text does not say [m].

        Raises:
            AgvMotionError: The zone cannot be read, or is none.

        """
        if self.zone:
            return PathPlanner(zone_of_text(self.zone, self.rim, home))
        if self.zone_file:
            return PathPlanner(load_zone(find_config(self.zone_file), self.rim))
        return None

    def require_to_come(self, before: MotionGeneratorParameters, now: float) -> None:
        """Raise where a rest is asked for that is over already.

        Args:
            before: The parameters in force.
            now: Time of the node's clock [s since 1970].

        Raises:
            ConfigurationError: It is.

        """
        until = self.rest_until
        if until != before.rest_until and 0.0 < until <= now:
            msg = (
                f'rest_until = {until:.0f} s is past: it is {now:.0f} s now; give a time to come, '
                'in seconds since 1970, or 0 to end the rest'
            )
            raise ConfigurationError(msg)

    def sharing(self) -> TrafficParameters:
        """Return how the zone is shared by a platform of this outline."""
        return replace(self.traffic, body=self.rim)
