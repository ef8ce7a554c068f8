"""What each participant of ROS 2 consists of, in its own words: all ends of each of its nodes.

It is said on `ros_discovery_info` whenever something is opened or closed, and the newest word is
repeated to whoever comes later. rclpy cannot hear it, all of whose names of topics begin with a
slash: so it is read by the functions below rclpy.

Source: rmw_dds_common/msg/ParticipantEntitiesInfo; rmw/rmw.h and rmw/types.h of ROS 2 Jazzy.
"""

from __future__ import annotations

import ctypes
from ctypes import byref, c_bool, c_char_p, c_int, c_size_t, c_uint64, c_void_p
from typing import TYPE_CHECKING, Any, TypeAlias

from agv_motion.cli.graph.participants import GRAPH_TOPIC, PREFIX
from agv_motion.model.cdr_reader import CdrReader

if TYPE_CHECKING:
    from typing_extensions import Self

GID = 16
"""Bytes of the identity of a participant, a reader or a writer"""

Told: TypeAlias = dict[bytes, frozenset[tuple[bytes, str]]]
"""Of each participant the identities of all its ends, each with the name of its node"""

KEEP_ALL, RELIABLE, TRANSIENT_LOCAL = 2, 1, 1
"""As rmw/types.h numbers them; with 0 the middleware decides"""

TYPE_SUPPORT = (
    'rosidl_typesupport_c__get_message_type_support_handle__'
    'rmw_dds_common__msg__ParticipantEntitiesInfo'
)


class _Qos(ctypes.Structure):
    """rmw_qos_profile_t."""

    _fields_ = (
        ('history', c_int),
        ('depth', c_size_t),
        ('reliability', c_int),
        ('durability', c_int),
        ('deadline_and_lifespan', c_uint64 * 4),
        ('liveliness', c_int),
        ('liveliness_lease', c_uint64 * 2),
        ('avoid_ros_namespace_conventions', c_bool),
    )


class _Options(ctypes.Structure):
    """rmw_subscription_options_t."""

    _fields_ = (
        ('payload', c_void_p),
        ('ignore_local_publications', c_bool),
        ('unique_network_flow', c_int),
        ('content_filter', c_void_p),
    )


class _Allocator(ctypes.Structure):
    """rcutils_allocator_t: four functions and their state."""

    _fields_ = (('parts', c_void_p * 5),)


class _Bytes(ctypes.Structure):
    """rcutils_uint8_array_t."""

    _fields_ = (
        ('buffer', c_void_p),
        ('length', c_size_t),
        ('capacity', c_size_t),
        ('allocator', _Allocator),
    )


def entities(message: bytes) -> tuple[bytes, frozenset[tuple[bytes, str]]]:
    """Return which participant said a message, and each of its ends with the name of its node.

    Raises:
        SignalError: It is no such message.

    """
    reader = CdrReader(message)
    participant = reader.octets(GID)[:PREFIX]
    found = set()
    for _ in range(reader.count()):
        reader.text()  # the namespace of a node
        name = reader.text()
        for _ in ('readers', 'writers'):
            found |= {(reader.octets(GID), name) for _ in range(reader.count())}
    return participant, frozenset(found)


class ParticipantEntities:
    """Hears for a node what all participants say, while it is entered."""

    def __init__(self, node: Any) -> None:
        """Hear nothing yet."""
        self._node = node
        self._subscription = None
        self._told: Told = {}

    def __enter__(self) -> Self:
        """Subscribe, where ROS stands on DDS."""
        try:
            self._subscribe()
        except (OSError, AttributeError):  # other libraries than those of ROS 2 Jazzy on DDS
            self._subscription = None
        return self

    def _subscribe(self) -> None:
        types = ctypes.CDLL('librmw_dds_common__rosidl_typesupport_c.so')
        kind = _function(types, TYPE_SUPPORT, c_void_p)()
        self._rmw = rmw = ctypes.CDLL('librcl.so')  # and whatever it is linked with
        options = _function(rmw, 'rmw_get_default_subscription_options', _Options)()
        allocator = _function(rmw, 'rcutils_get_default_allocator', _Allocator)()
        self._bytes = _Bytes(allocator=allocator)
        qos = _Qos(
            history=KEEP_ALL,
            reliability=RELIABLE,
            durability=TRANSIENT_LOCAL,
            avoid_ros_namespace_conventions=True,
        )
        self._below = _function(rmw, 'rcl_node_get_rmw_handle', c_void_p)(
            c_void_p(self._node.handle.pointer)
        )
        self._subscription = _function(rmw, 'rmw_create_subscription', c_void_p)(
            c_void_p(self._below),
            c_void_p(kind),
            c_char_p(GRAPH_TOPIC.encode()),
            byref(qos),
            byref(options),
        )

    def told(self) -> Told | None:
        """Return the newest that each participant has said, or None where nothing can be heard."""
        if not self._subscription:
            return None
        taken = c_bool()
        take = _function(self._rmw, 'rmw_take_serialized_message', c_int)
        while (
            not take(c_void_p(self._subscription), byref(self._bytes), byref(taken), None) and taken
        ):
            message = ctypes.string_at(self._bytes.buffer, self._bytes.length)
            participant, ends = entities(message)
            self._told[participant] = ends
        return self._told

    def __exit__(self, *_: object) -> None:
        """Unsubscribe: before the node goes, to which it belongs."""
        if self._subscription:
            _function(self._rmw, 'rmw_destroy_subscription', c_int)(
                c_void_p(self._below), c_void_p(self._subscription)
            )
            _function(self._rmw, 'rcutils_uint8_array_fini', c_int)(byref(self._bytes))
            self._subscription = None


def _function(library: ctypes.CDLL, name: str, result: Any) -> Any:
    function = library[name]  # a new one each time, whose types nobody else changes
    function.restype = result
    return function
