"""One demo a ROS domain: two on the same topics would drive each other's robots."""

from __future__ import annotations

import os
import socket
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError
from agv_motion.ros.stop import end_at_once

if TYPE_CHECKING:
    from collections.abc import Callable

    from rich.console import Console

DOMAINS = range(102)
"""Those whose ports are not given to others by Linux"""

_held: list[socket.socket] = []
"""What marks the domain as taken, for the life of this process"""


def begin(console: Console) -> None:
    """Begin a demo: on this machine alone, in a domain without another, ended by any signal.

    Raises:
        ConfigurationError: As `take_domain`.

    """
    # what drives a simulated robot must never reach a real one on the network
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    end_at_once()  # until the graph is there
    take_domain(console.print)


def take_domain(say: Callable[[str], None]) -> None:
    """Take the domain of the environment for this process's demo, or else the next free one.

    Args:
        say: Tells the person at the terminal where the demo went.

    Raises:
        ConfigurationError: The domain was asked for by ``ROS_DOMAIN_ID`` and has a demo already,
            or all domains have.

    """
    asked = os.environ.get('ROS_DOMAIN_ID', '')
    for domain in [int(asked)] if asked.isdecimal() else DOMAINS:
        mark = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        try:
            mark.bind(f'\0agv_motion_demo_{domain}')  # a name without a file: gone with the process
        except OSError:
            mark.close()
            continue
        _held.append(mark)
        if domain and not asked:
            os.environ['ROS_DOMAIN_ID'] = str(domain)
            say(f'Another demo is running: this one takes ROS_DOMAIN_ID={domain}.')
        return
    msg = (
        f'ROS_DOMAIN_ID={asked} has a demo already: wait for its end, or unset the variable and '
        'this one takes a free domain'
    )
    raise ConfigurationError(msg)
