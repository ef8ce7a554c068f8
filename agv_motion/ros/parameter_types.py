"""Whether a value is of the type that a parameter wants, and what to write instead."""

from __future__ import annotations

from typing import Any

WORDS = {
    float: 'a decimal number such as 1.0',
    int: 'a whole number',
    bool: 'true or false',
    str: "a text, in quotation marks ('12', 'on')",
}


def wrong_type(name: str, value: Any, wanted: Any) -> str:
    """Return what is wrong with a value, and the remedy; empty if it fits.

    Args:
        name: Of the parameter.
        value: As rclpy has it.
        wanted: float, int, bool, str, or a tuple of one of them.

    """
    listed = not isinstance(value, (str, bool, int, float))
    kinds = getattr(wanted, '__args__', None)
    kind = kinds[0] if kinds else wanted
    elements = list(value) if listed and value is not None else [value]
    if listed is bool(kinds) and value is not None and all(type(e) is kind for e in elements):
        return ''
    shown = elements if listed and value is not None else value
    words = WORDS[kind]
    if kinds:
        words = f'a list, [...], each of it {words}'
    remedy = ''
    if kind is float and listed is bool(kinds) and all(type(e) in {int, float} for e in elements):
        exact = [float(e) for e in elements]
        remedy = f': write {exact if listed else exact[0]}'
    return f'{name} = {shown!r}: expected {words}{remedy}'
