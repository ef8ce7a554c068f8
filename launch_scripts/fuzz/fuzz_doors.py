"""Fuzz every door of the package: any input is used or refused, in time, and all stays finite.

    python launch_scripts/fuzz/fuzz_doors.py [INPUTS] [SEED] [DOOR ...]

So many inputs a door (100,000), all doors or those whose names begin so. Ends with status 1 when
something was uncaught, came out that is not finite, or took longer than a second of processor time.
The doors are in `fuzz_files.py`, `fuzz_beside_bags.py` and `fuzz_nodes.py`; test/test_doors.py is
the short form.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import fuzz_beside_bags
import fuzz_files
import fuzz_nodes
from fuzzing import fuzz_all

if TYPE_CHECKING:
    import random
    from collections.abc import Callable, Iterator


def doors() -> Iterator[tuple[str, Callable[[random.Random], Callable[[], None]]]]:
    """Yield all doors by name."""
    yield from fuzz_files.doors()
    yield from fuzz_beside_bags.doors()
    yield from fuzz_nodes.doors()


def main(words: list[str]) -> int:
    """Fuzz, print a table, and return the status."""
    inputs = int(words[0]) if words else 100_000
    seed = int(words[1]) if words[1:] else 1
    asked = tuple(words[2:]) or ('',)
    return fuzz_all(
        ((name, door) for name, door in doors() if name.startswith(asked)), inputs, seed
    )


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
