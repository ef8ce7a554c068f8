"""Which topics: by name, by regular expression, all but some; in the words of ros2 bag."""

from __future__ import annotations

import re
from dataclasses import dataclass

from agv_motion.errors import ConfigurationError


@dataclass(frozen=True)
class Selection:
    """A choice among topics. What is excluded stays out, however else it was named."""

    everything: bool = False
    topics: tuple[str, ...] = ()
    """full names"""
    regex: str = ''
    """found anywhere in the name; give ^ and $ for the whole"""
    exclude_topics: tuple[str, ...] = ()
    exclude_regex: str = ''
    hidden: bool = False
    """whether ``everything`` and ``regex`` mean topics with a _ before a part of the name too; they
    mean those of services (``_service_event``) and actions (``_action``) in any case"""

    def __post_init__(self) -> None:
        """Check both expressions."""
        _compile('regex', self.regex)
        _compile('exclude_regex', self.exclude_regex)

    def takes(self, topic: str) -> bool:
        """Return whether ``topic`` (its full name) is chosen."""
        if topic in self.exclude_topics:
            return False
        if self.exclude_regex and re.search(self.exclude_regex, topic):
            return False
        if topic in self.topics:
            return True
        matched = self.everything or bool(self.regex and re.search(self.regex, topic))
        return matched and (self.hidden or '/_' not in topic or _tells_of_others(topic))


def _tells_of_others(topic: str) -> bool:
    """Return whether a hidden topic tells of a service or an action, which is not hidden."""
    shown, _, last = topic.rpartition('/')
    if shown.endswith('/_action'):
        shown, last = shown.removesuffix('/_action'), '_action'
    return last in ('_service_event', '_action') and '/_' not in shown


def _compile(name: str, pattern: str) -> None:
    try:
        re.compile(pattern)
    except re.error as error:
        msg = f"{name} = '{pattern}': not a regular expression ({error})"
        raise ConfigurationError(msg) from error
