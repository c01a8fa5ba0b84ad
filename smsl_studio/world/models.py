"""The folder of the robots' files, such as ``franka_panda/panda.urdf``. It comes with PyBullet, and
is found without loading the engine."""

from __future__ import annotations

from pathlib import Path


def models_folder() -> Path | None:
    """Return the folder. None if PyBullet is not installed."""
    try:
        import pybullet_data
    except ImportError:
        return None
    return Path(pybullet_data.getDataPath())
