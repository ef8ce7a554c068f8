"""Options that the verbs of `agv topic` share."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from agv_motion.cli.graph.completion import topic_names
from agv_motion.errors import ConfigurationError

Topic = Annotated[
    str,
    typer.Argument(help="Name of the topic, such as '/cmd_vel'.", autocompletion=topic_names),
]


def preset_qos(preset: str, depth: int = 0, reliability: str = '', durability: str = '') -> Any:
    """Return a preset of rclpy by its short name, with what was asked for changed.

    Raises:
        ConfigurationError: A word is not one of the short names.

    """
    from copy import copy

    from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, ReliabilityPolicy

    for word, policy in (
        (preset, QoSPresetProfiles),
        (reliability, ReliabilityPolicy),
        (durability, DurabilityPolicy),
    ):
        if word and word not in policy.short_keys():
            msg = f"QoS '{word}': choose one of {', '.join(policy.short_keys())}"
            raise ConfigurationError(msg)
    qos = copy(QoSPresetProfiles.get_from_short_key(preset))
    if reliability:
        qos.reliability = ReliabilityPolicy.get_from_short_key(reliability)
    if durability:
        qos.durability = DurabilityPolicy.get_from_short_key(durability)
    if depth > 0:
        qos.depth = depth
    return qos
