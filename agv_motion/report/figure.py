"""Figures: matplotlib without a screen, where it is installed."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from agv_motion.errors import ConfigurationError
from agv_motion.files.unfinished import replacing

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@contextmanager
def figure(path: Path, mosaic: list[Any], **options: Any) -> Iterator[dict[str, Any]]:
    """Yield the axes of a mosaic by name, and write them to ``path`` as a picture, whole or not.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    try:
        import matplotlib as mpl
    except ImportError as error:
        msg = 'a figure needs matplotlib: pip install "agv_motion[plot]"'
        raise ConfigurationError(msg) from error
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    drawn, axes = plt.subplot_mosaic(mosaic, constrained_layout=True, **options)
    try:
        yield axes
        with replacing(path) as made:
            drawn.savefig(made, dpi=110)
    except ValueError as error:
        msg = f"cannot draw '{path}': {error}"
        raise ConfigurationError(msg) from error
    finally:
        plt.close(drawn)
