"""The folders of the files that ship with the code: plugins, samples, resources, pages.

In a checkout these are the folders at the top, so that an edit there has an effect at once. In an
installed wheel they lie inside the package. All other code asks this module for them.
"""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def plugins_dir() -> Path:
    """Return the folder of the plugins that ship with the program."""
    return _shipped("plugins")


def samples_dir() -> Path:
    """Return the folder of the sample blueprints."""
    return _shipped("samples")


def resources_dir() -> Path:
    """Return the folder of icons and other pictures."""
    return _shipped("resources")


def docs_dir() -> Path:
    """Return the folder of the pages that the window shows as help."""
    return _shipped("docs")


def _shipped(name: str) -> Path:
    checkout = _PACKAGE.parent
    if (checkout / "pyproject.toml").is_file() and (checkout / name).is_dir():
        return checkout / name
    return _PACKAGE / "_shipped" / name
