"""Inputs by the thousand to doors of the package, and what goes wrong: for the scripts `fuzz_*`."""

from __future__ import annotations

import random
import sys
import time
import traceback
from collections import Counter
from typing import TYPE_CHECKING

from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

LONGEST = 1.0
"""[s] of processor time that one input may take"""


def place(error: BaseException) -> str:
    """Return what was raised, and where in the package or, outside of it, at last."""
    frames = traceback.extract_tb(error.__traceback__)
    ours = [frame for frame in frames if 'agv_motion/' in frame.filename] or frames
    last = ours[-1]
    name = last.filename.rpartition('agv_motion/')[2]
    return f'{type(error).__name__} at {name}:{last.lineno} ({error!s:.100})'


def fuzz(
    name: str, door: Callable[[random.Random], Callable[[], None]], inputs: int, seed: int
) -> Counter[str]:
    """Give a door so many inputs; return what went wrong, and how often.

    Args:
        name: Of the door.
        door: Makes of a generator of random numbers one input, and what gives it to the door.
        inputs: How many.
        seed: Input ``i`` depends on it, the name and ``i`` alone, unless the door has a memory.

    """
    found: Counter[str] = Counter()
    for number in range(inputs):
        act = door(random.Random(f'{seed} {name} {number}'))  # noqa: S311
        begun = time.process_time()
        try:
            act()
        except AgvMotionError:
            pass
        except Exception as error:  # noqa: BLE001 - that is what is looked for
            found[place(error)] += 1
            if found[place(error)] == 1:
                sys.stderr.write(f'{name} {number}: {"".join(traceback.format_exception(error))}\n')
        took = time.process_time() - begun
        if took > LONGEST:
            found['took too long'] += 1
            sys.stderr.write(f'{name} {number}: took {took:.1f} s\n')
    return found


def fuzz_all(
    doors: Iterable[tuple[str, Callable[[random.Random], Callable[[], None]]]],
    inputs: int,
    seed: int,
) -> int:
    """Give so many inputs to each door, print a table, and return the status: 1 if any is wrong."""
    wrong = 0
    for name, door in doors:
        begun = time.monotonic()
        found = fuzz(name, door, inputs, seed)
        print(f'{name:<36} {inputs:>8} inputs {time.monotonic() - begun:7.1f} s', flush=True)
        for what, count in found.most_common():
            print(f'    {count:>6} times: {what}', flush=True)
        wrong += len(found)
    return int(wrong > 0)
