"""Where the files that ship beside the code stand: plugins, samples, resources.

In a checkout they are the folders at the top, so that an edit there is seen at once; in an
installed wheel they lie inside the package. Nobody else may work this out again.
"""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def plugins_dir() -> Path:
    """The folder of the plugins that ship with the program."""
    return _shipped("plugins")


def samples_dir() -> Path:
    """The folder of the sample blueprints."""
    return _shipped("samples")


def resources_dir() -> Path:
    """The folder of icons and other pictures."""
    return _shipped("resources")


def _shipped(name: str) -> Path:
    checkout = _PACKAGE.parent
    if (checkout / "pyproject.toml").is_file() and (checkout / name).is_dir():
        return checkout / name
    return _PACKAGE / "_shipped" / name
