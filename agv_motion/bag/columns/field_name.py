"""Fields as people name them: a topic and what is in it, such as ``/cmd_vel/twist/linear``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from agv_motion.bag.reader import BagReader


def topic_and_field(bag: BagReader, name: str) -> tuple[str, str]:
    """Return the topic at the beginning of a name, and the path of the field after it, or ''.

    Raises:
        ConfigurationError: No topic of the bag is the beginning of it.

    """
    fits = [topic for topic in bag.topics if name == topic or name.startswith(f'{topic}/')]
    if not fits:
        msg = f"'{name}' is in no topic of bag {bag.path}; it has {', '.join(sorted(bag.topics))}"
        raise ConfigurationError(msg)
    topic = max(fits, key=len)
    return topic, name[len(topic) :].strip('/').replace('/', '.')
