"""Whether `agv` hears the whole graph, each time anew: against the genuine ros2, on what runs now.

    agv demo --minutes 600 --time-factor 1 &      # or another graph
    python launch_scripts/trials/trial_discovery.py --times 50 --ros2 /opt/ros/jazzy/bin/ros2

Each time a process of its own joins the graph as `agv topic list -v` and `agv node list` do, and
tells topics, types, nodes and how many publish and subscribe. Exits with 1 where one differs from
ros2 (or, without it, from the first). How long each took is told beside its processor time.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

from agv_motion.cli.graph.nodes import node_names
from agv_motion.cli.graph.session import joined, topics

OWN = '/rosout', '/parameter_events'
"""Topics that each who looks publishes too: one more for us, one for the daemon of ros2"""


def answer() -> str:
    """Return what is there, as one who has just come tells it."""
    with joined(whole=True) as node:
        found = [
            f' * {name} [{", ".join(types)}] {number} {word}{"s" * (number > 1)}'
            for name, types in topics(node).items()
            if name not in OWN
            for word, count in (
                ('publisher', node.count_publishers),
                ('subscriber', node.count_subscribers),
            )
            if (number := count(name))
        ]
        return '\n'.join(sorted([*found, *node_names(node)]))


def genuine(ros2: Path) -> str:
    """Return the same from ros2, which knows its packages by its own environment."""
    prefix = ros2.resolve().parent.parent
    environment = {key: value for key, value in os.environ.items() if key != 'PYTHONPATH'}
    environment |= {'AMENT_PREFIX_PATH': str(prefix), 'PATH': f'{ros2.parent}:{os.environ["PATH"]}'}
    lines: list[str] = []
    for words in (('topic', 'list', '-v'), ('node', 'list')):
        told = subprocess.run(  # noqa: S603 - the words are ours
            [ros2, *words], capture_output=True, text=True, check=True, env=environment
        )
        lines += told.stdout.splitlines()
    own = tuple(f' * {name} ' for name in OWN)
    return '\n'.join(
        sorted(x for x in lines if x.startswith((' *', '/')) and not x.startswith(own))
    )


def main() -> int:
    """Ask again and again."""
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--times', type=int, default=50)
    parser.add_argument('--ros2', type=Path, help='the genuine ros2')
    parser.add_argument('--once', action='store_true', help='only tell what is there')
    options = parser.parse_args()
    if options.once:
        begun = time.monotonic()
        sys.stdout.write(f'{answer()}\n')
        sys.stderr.write(
            f'{time.monotonic() - begun:.2f} s, processor {time.process_time():.2f} s\n'
        )
        return 0
    truth = genuine(options.ros2) if options.ros2 else ''
    differ = 0
    for number in range(options.times):
        told = subprocess.run(  # noqa: S603 - the words are ours
            [sys.executable, __file__, '--once'], capture_output=True, text=True, check=False
        )
        truth = truth or told.stdout.rstrip()
        sys.stdout.write(f'{number}: {told.stderr}')
        if odd := set(told.stdout.splitlines()) ^ set(truth.splitlines()):
            differ += 1
            sys.stdout.write('\n'.join([f'{len(odd)} lines differ:', *sorted(odd)[:10], '']))
    lines = len(truth.splitlines())
    sys.stdout.write(f'{options.times - differ} of {options.times} the same {lines} lines\n')
    return int(differ > 0)


if __name__ == '__main__':
    sys.exit(main())
