"""Who publishes a topic and how: message classes by name, and quality of service to meet it."""

from __future__ import annotations

import importlib.util
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from agv_motion.bag.cdr.definitions import split
from agv_motion.bag.quality_of_service import FOREVER, OfferedQos, kept
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

    from rclpy.topic_endpoint_info import TopicEndpointInfo

DEEP = 1000
"""Messages that may wait for a recorder: a tenth of a second at 10,000 a second."""

SHALLOW = 100
"""Messages that a player keeps for listeners that are slow."""


def message_class(name: str) -> Any:
    """Return the class of a message type such as ``std_msgs/msg/String``.

    Raises:
        ConfigurationError: It is not installed, or the name is none of a type.

    """
    split(name)
    package, _, rest = name.partition('/')
    folder, _, short = rest.rpartition('/')
    try:
        return getattr(interface_module(package, folder or 'msg'), short)
    except (ImportError, AttributeError) as error:
        msg = f"message type '{name}' is not installed: install {package}, or source its workspace"
        raise ConfigurationError(msg) from error


def interface_module(package: str, folder: str) -> ModuleType:
    """Return the module of the messages, services or actions of a package.

    Of a package without such a folder nothing runs: the name of a type comes out of a bag or from
    the network, and any module of Python would run that is imported by its first word.

    Raises:
        ImportError: The package is not installed, or has no such folder.

    """
    spec = None
    if package.isidentifier():
        with suppress(ValueError):  # such as __main__
            spec = importlib.util.find_spec(package)
    places = (spec and spec.submodule_search_locations) or ()
    if not any(Path(place, folder, '__init__.py').is_file() for place in places):
        msg = f'{package} has no {folder}'
        raise ModuleNotFoundError(msg)
    return importlib.import_module(f'{package}.{folder}')


def offered(publishers: Sequence[TopicEndpointInfo]) -> list[OfferedQos]:
    """Return the quality of service of each publisher, as a bag keeps it."""
    return [offer(publisher.qos_profile) for publisher in publishers]


def offer(qos: QoSProfile) -> OfferedQos:
    """Return a profile as a bag keeps it."""
    return OfferedQos(
        depth=qos.depth,
        reliability=qos.reliability.name.lower(),
        durability=qos.durability.name.lower(),
        history=qos.history.name.lower(),
        liveliness=qos.liveliness.name.lower(),
        deadline=_nanoseconds(qos.deadline),
        lifespan=_nanoseconds(qos.lifespan),
        lease_duration=_nanoseconds(qos.liveliness_lease_duration),
    )


def _nanoseconds(duration: Any) -> int:
    return min(int(duration.nanoseconds), FOREVER) or FOREVER


def offering(recorded: Sequence[OfferedQos]) -> QoSProfile:
    """Return the profile that satisfies whoever listened to any of the recorded publishers."""
    reliable = not recorded or any(offer.reliability == 'reliable' for offer in recorded)
    latched = kept(recorded)
    return QoSProfile(
        depth=latched or max(SHALLOW, *(offer.depth for offer in recorded), 0),
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def matching(offers: Sequence[OfferedQos], *, latched: bool) -> QoSProfile:
    """Return a deep profile that hears all publishers; the weakest of them sets the terms.

    Args:
        offers: What each publisher offers.
        latched: Ask for what was sent before, which only latched publishers grant.

    """
    reliable = all(offer.reliability == 'reliable' for offer in offers)
    return QoSProfile(
        depth=DEEP,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
