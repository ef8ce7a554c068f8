"""Message types that belong to services and actions: what their topics carry.

A service is defined by two messages with ``---`` between them, an action by three. From these
follow the types of hidden topics that rosbag2 records: ``_service_event``, ``_action/feedback``.
Source: REP-2012; https://design.ros2.org/articles/actions.html
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

SEPARATOR = '=' * 80
"""Stands before each type that a definition adds."""
SECTIONS = {'srv': ('_Request', '_Response'), 'action': ('_Goal', '_Result', '_Feedback')}
"""Ends of the names of the messages that the sections of a file define."""
_UUID = 'unique_identifier_msgs/UUID goal_id'
_FOLLOWING = {
    '_FeedbackMessage': f'{_UUID}\n{{0}}_Feedback feedback',
    '_SendGoal_Request': f'{_UUID}\n{{0}}_Goal goal',
    '_SendGoal_Response': 'bool accepted\nbuiltin_interfaces/Time stamp',
    '_GetResult_Request': _UUID,
    '_GetResult_Response': 'int8 status\n{0}_Result result',
    '_Event': (
        'service_msgs/ServiceEventInfo info\n{0}_Request[<=1] request\n{0}_Response[<=1] response'
    ),
}
"""Definitions that follow from the others, by the end of their name."""
_COMMON = {
    'unique_identifier_msgs/UUID': 'uint8[16] uuid',
    'builtin_interfaces/Time': 'int32 sec\nuint32 nanosec',
    'service_msgs/ServiceEventInfo': (
        'uint8 event_type\nbuiltin_interfaces/Time stamp\n'
        'char[16] client_gid\nint64 sequence_number'
    ),
}


def following(name: str) -> str:
    """Return the definition of PACKAGE/NAME that follows from its name; '' where none does."""
    if name in _COMMON:
        return _COMMON[name]
    for end, text in _FOLLOWING.items():
        if name.endswith(end):
            return text.format(name.removesuffix(end))
    return ''


def base(name: str) -> str:
    """Return the name of the service or action to which a message type belongs."""
    for end in (*_FOLLOWING, *SECTIONS['srv'], *SECTIONS['action']):
        name = name.removesuffix(end)
    return name


def sections(name: str, lines: list[str]) -> Iterator[tuple[str, list[str]]]:
    """Yield name and lines of each message that a file of a service or action defines.

    Args:
        name: Of the service or action, or of a type that belongs to it; of a message, if there is
            only one section, which is then returned as it is.
        lines: Of the file.

    """
    bounds = [number for number, line in enumerate(lines) if line.strip() == '---']
    if not bounds:
        yield name, lines
        return
    ends = SECTIONS['srv'] if len(bounds) == 1 else SECTIONS['action']
    edges = zip([0, *(bound + 1 for bound in bounds)], [*bounds, len(lines)], strict=True)
    for end, (first, last) in zip(ends, edges, strict=False):
        yield f'{base(name)}{end}', lines[first:last]
