"""What a node says of a file that cannot be used: its content only to who may read it anyway.

Logs, answers and diagnostics go to the whole network. So a file is quoted only if it was named when
the node was started, by whoever started it, or lies in the folder of the configuration. Of any
other that somebody names over the network, line, column and the kind of fault are told.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.ros.config import config_folders

if TYPE_CHECKING:
    from collections.abc import Collection

    from agv_motion.errors import AgvMotionError


def told(error: AgvMotionError, given: Collection[str]) -> str:
    """Return the message of an error, as a node may tell it.

    Args:
        error: May quote a file.
        given: Texts with which the node was started, names of files among them.

    """
    if not error.unquoted:
        return str(error)
    folders = [folder.resolve() for folder in config_folders()]
    file = Path(error.file).resolve()
    named = {Path(name).resolve() for name in given if name and '\0' not in name}
    if file in named or any(folder in file.parents for folder in folders):
        return str(error)
    return error.unquoted
