"""Errors of the package: one base class, one subclass per kind of mistake.

Every message gives the value, what was expected, and what to do about it.
"""


class AgvMotionError(Exception):
    """Base of every error that this package raises on purpose."""


class GeometryError(AgvMotionError, ValueError):
    """The described vehicle, zone or path cannot exist: wrong shape, non-finite, out of range."""


class SignalError(AgvMotionError, ValueError):
    """A measured or commanded value is malformed: wrong length or non-finite."""


class ConfigurationError(AgvMotionError, ValueError):
    """A parameter, a file or a combination of them cannot be used as it stands."""


class SourceError(AgvMotionError, OSError):
    """A source of data (file, serial line, bag) cannot be opened or read."""
