"""Where the files of `config/` are: installed, or beside the package."""

from __future__ import annotations

import sys
from contextlib import suppress
from pathlib import Path

from ament_index_python.packages import get_package_share_directory

import agv_motion
from agv_motion.errors import ConfigurationError


def config_folders() -> list[Path]:
    """Return the folders in which configuration is looked for, first come first served."""
    folders = [
        Path(sys.prefix) / 'share' / 'agv_motion' / 'config',
        Path(agv_motion.__file__).parents[1] / 'config',
    ]
    with suppress(LookupError, OSError):  # no AMENT_PREFIX_PATH, or an editable installation
        folders.insert(0, Path(get_package_share_directory('agv_motion')) / 'config')
    return list(dict.fromkeys(folders))


def find_config(name: str) -> Path:
    """Return the path of a file given by path, or by name among those of the package.

    Raises:
        ConfigurationError: There is no such file; the message says where it was looked for.

    """
    candidates = [Path(name), *(folder / name for folder in config_folders())]
    with suppress(OSError, ValueError):  # a name that is none: too long, or with a NUL in it
        for candidate in candidates:
            if candidate.is_file():
                return candidate
    places = ', '.join(str(folder) for folder in config_folders() if folder.is_dir())
    places = places or 'an installed config folder'
    msg = f'no file {name!r:.200}, neither by that path nor in {places}'
    raise ConfigurationError(msg)
