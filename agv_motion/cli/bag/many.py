"""Which bags are meant: one, or all in a folder, each with where its result goes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path


def jobs(sources: Sequence[Path], target: Path) -> list[tuple[Path, Path]]:
    """Return each bag with where its result goes: in ``target``, or there itself if it is one.

    Raises:
        ConfigurationError: There is no bag, or two of the same name.

    """
    if len(sources) == 1 and (is_bag(sources[0]) or not sources[0].is_dir()):
        return [(sources[0], target)]
    found = [
        bag
        for source in sources
        for bag in ([source] if is_bag(source) else sorted(filter(is_bag, source.iterdir())))
    ]
    results = {target / bag.stem for bag in found}
    if not found or len(results) < len(found):
        what = 'two bags of the same name' if found else 'no bag'
        msg = f'{what} in {", ".join(map(str, sources))}: give bags, or folders of bags'
        raise ConfigurationError(msg)
    return [(bag, target / bag.stem) for bag in found]


def is_bag(path: Path) -> bool:
    """Return whether there is a bag: a folder with its files, or a file."""
    if path.is_dir():
        return any(path.glob('*.mcap*')) or any(path.glob('*.db3*'))
    return path.suffix in {'.mcap', '.db3'}
