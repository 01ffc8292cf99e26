"""Exceptions and warnings of the package."""

from __future__ import annotations

from typing import Any


class AsperityError(Exception):
    """Every exception that the package raises by itself."""


class InputError(AsperityError, ValueError):
    """Bad input; no computation was started.

    Attributes:
        file: the file, ``"dict"`` or ``"text"`` that was refused, or None.
        key: the key or argument, such as ``"loading.slip_rate"``, or None.
        reason: what is wrong with it and what is allowed.
    """

    def __init__(self, message: str, file: str | None = None, key: str | None = None, reason: str = ""):
        super().__init__(message)
        self.file = file
        self.key = key
        self.reason = reason or message


class RunError(AsperityError, RuntimeError):
    """A computation failed.

    Attributes:
        run: a :class:`asperity.Run` with the steps before the failure, or None.
    """

    def __init__(self, message: str, run: Any = None):
        super().__init__(message)
        self.run = run


class ModelWarning(UserWarning):
    """A limitation of a result."""
