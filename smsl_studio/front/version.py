"""The version of the program."""

from __future__ import annotations


def version() -> str:
    """The version that is installed, ``0+checkout`` where none is."""
    from importlib.metadata import PackageNotFoundError
    from importlib.metadata import version as installed

    try:
        return installed("smsl-studio")
    except PackageNotFoundError:
        return "0+checkout"
