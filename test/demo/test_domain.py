"""Two demos at once never share a domain."""

from __future__ import annotations

import os
import subprocess
import sys

TAKE = """
from agv_motion.demo.domain import take_domain
take_domain(print)
print('taken', flush=True)
input()
"""


def _take(**environment):
    """Start a process that takes a domain and holds it until it is told to end."""
    kept = {name: value for name, value in os.environ.items() if name != 'ROS_DOMAIN_ID'}
    return subprocess.Popen(  # noqa: S603 - our own
        [sys.executable, '-c', TAKE], env=kept | environment, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip


def _until_taken(process):
    lines = [process.stdout.readline()]
    while lines[-1] and lines[-1] != 'taken\n':
        lines.append(process.stdout.readline())
    return lines


def test_a_second_demo_takes_another_domain_and_says_which():
    processes = [_take(), _take(), _take()]
    told = [''.join(_until_taken(process)) for process in processes]
    for process in processes:
        process.communicate('\n')
    domains = [line.split('ROS_DOMAIN_ID=')[-1] for line in told]
    assert len(set(domains)) == 3
    assert sum('Another demo is running: this one takes' in text for text in told) >= 2


def test_a_domain_that_was_asked_for_is_refused_while_it_has_a_demo():
    first = _take(ROS_DOMAIN_ID='77')
    _until_taken(first)
    second = _take(ROS_DOMAIN_ID='77')
    _, errors = second.communicate('\n')
    assert second.returncode == 1
    assert 'ROS_DOMAIN_ID=77 has a demo already' in errors
    first.communicate('\n')
    third = _take(ROS_DOMAIN_ID='77')
    assert _until_taken(third) == ['taken\n']
    third.communicate('\n')
