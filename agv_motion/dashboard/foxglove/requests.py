"""What a client can say in the Foxglove websocket protocol."""

from __future__ import annotations

from typing import Any, NamedTuple

from agv_motion.errors import AgvMotionError


class ProtocolError(AgvMotionError):
    """A message of a client that is none, or that asks for what cannot be."""


class Subscribe(NamedTuple):
    """Asks for channels."""

    channels: dict[int, int]
    """channel of each subscription that the client numbers"""


class Unsubscribe(NamedTuple):
    """Asks for subscriptions no more."""

    subscriptions: list[int]


class ClientChannel(NamedTuple):
    """A topic on which a client wants to publish."""

    id: int
    topic: str
    encoding: str
    type: str


class Advertise(NamedTuple):
    """Wants to publish."""

    channels: list[ClientChannel]


class Unadvertise(NamedTuple):
    """Publishes no more."""

    channels: list[int]


class GetParameters(NamedTuple):
    """Asks for values."""

    names: list[str]
    """empty: all"""
    id: str


class SetParameters(NamedTuple):
    """Wants values to be."""

    values: dict[str, Any]
    id: str


class WatchParameters(NamedTuple):
    """Wants to be told, or no more, when values change."""

    names: list[str]
    """empty: all"""
    on: bool


class WatchGraph(NamedTuple):
    """Wants to be told, or no more, who speaks with whom."""

    on: bool


class FetchAsset(NamedTuple):
    """Asks for a file."""

    uri: str
    id: int


class Publish(NamedTuple):
    """A message to be published."""

    channel: int
    data: bytes


class Call(NamedTuple):
    """A request to a service."""

    service: int
    id: int
    encoding: str
    data: bytes


class Control(NamedTuple):
    """How a recording is to be played."""

    playing: bool
    speed: float
    seek: int | None
    """log time to go to [ns]; None: stay"""
    id: str


Request = (
    Subscribe | Unsubscribe | Advertise | Unadvertise | GetParameters | SetParameters
    | WatchParameters | WatchGraph | FetchAsset | Publish | Call | Control
)  # fmt: skip
