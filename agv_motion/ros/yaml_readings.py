"""What a value was before YAML 1.1 read it: tools of ROS read each text of a file once more.

`ros2 param load`, `ros2 param set` and launch files make 600 of ``10:00`` (base 60), and a text of
``1e-06`` (their floats want a point). What can be told back unmistakably is taken for what was
meant; all else is left as it came, for the types to refuse.
"""

from __future__ import annotations

from math import isfinite
from typing import Any

import yaml

from agv_motion.parameters import TIME_OF_DAY

MINUTES_OF_A_DAY = 1440


def as_written(value: Any, wanted: Any, unit: str, present: Any) -> Any:
    """Return what somebody wrote of whom this ``value`` has come.

    Args:
        value: As rclpy has it.
        wanted: Type of the parameter: float, int, bool, str, or a tuple of one of them.
        unit: Of its row.
        present: What it is now.

    """
    if wanted is float and isinstance(value, str):
        return _number(value)
    if wanted == tuple[float, ...] and isinstance(value, str):
        return _numbers(value)
    if wanted is str and value is not None and not isinstance(value, str):
        if isinstance(present, str) and _is_read_as(present, value):
            return present
        if unit == TIME_OF_DAY and type(value) is int and 0 <= value < MINUTES_OF_A_DAY:
            return f'{value // 60:02}:{value % 60:02}'
    return value


def _number(text: str) -> float | str:
    try:
        number = float(text)
    except ValueError:
        return text
    return number if isfinite(number) else text


def _numbers(text: str) -> list[float] | str:
    """Return the numbers of a list that YAML has left a text since not all were any to it."""
    inner = text.strip()
    if not (inner.startswith('[') and inner.endswith(']')):
        return text
    numbers = [_number(each) for each in inner[1:-1].split(',')]
    floats = [each for each in numbers if isinstance(each, float)]
    return floats if len(floats) == len(numbers) else text


def _is_read_as(text: str, value: Any) -> bool:
    """Return whether YAML makes ``value`` of a ``text``."""
    try:
        read = yaml.safe_load(text)
    except yaml.YAMLError:
        return False
    return type(read) is type(value) and bool(read == value)
