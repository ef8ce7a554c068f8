"""Figures: matplotlib without a screen, where it is installed, in the hand of `style`."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from agv_motion.errors import ConfigurationError
from agv_motion.files.unfinished import replacing
from agv_motion.report.label_layout import settle
from agv_motion.report.style import settings

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

DOTS_PER_INCH = 120


def _shrink(picture: Path) -> None:
    """Let a PNG do with a palette of its own: half the size, and the eye sees the same."""
    if picture.suffix == '.png':
        from PIL import Image

        with Image.open(picture) as whole:
            flat = whole.convert('RGB').quantize(256, dither=Image.Dither.NONE)
        flat.save(picture, format='PNG', optimize=True)


def _write(drawn: Any, path: Path) -> None:
    """Write a figure, whole or not at all."""
    with replacing(path) as made:
        # a PNG is packed once, by `_shrink`
        loose = {'pil_kwargs': {'compress_level': 1}} if made.suffix == '.png' else {}
        drawn.savefig(made, dpi=DOTS_PER_INCH, **loose)
        _shrink(made)


@contextmanager
def figure(
    path: Path, mosaic: list[Any], *, theme: str = 'light', **options: Any
) -> Iterator[dict[str, Any]]:
    """Yield the axes of a mosaic by name, and write them to ``path`` as a picture, whole or not.

    Args:
        path: Of the picture; its ending says the kind: png, svg, pdf.
        mosaic: Names of the axes, as `matplotlib.pyplot.subplot_mosaic` takes them.
        theme: ``light`` or ``dark``.
        options: Of `matplotlib.pyplot.subplot_mosaic`.

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

    with mpl.rc_context(settings(theme)):
        drawn, axes = plt.subplot_mosaic(mosaic, layout='constrained', **options)
        try:
            yield axes
            settle(drawn)
            drawn.set_layout_engine(None)  # labels stand where this layout has room for them
            _write(drawn, path)
        except ValueError as error:
            msg = f"cannot draw '{path}': {error}"
            raise ConfigurationError(msg) from error
        finally:
            plt.close(drawn)
