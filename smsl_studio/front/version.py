"""The version of the program."""

from __future__ import annotations


def version() -> str:
    """Return the installed version, or ``0+checkout`` if the package is not installed."""
    from importlib.metadata import PackageNotFoundError
    from importlib.metadata import version as installed

    try:
        return installed("smsl-studio")
    except PackageNotFoundError:
        return "0+checkout"
