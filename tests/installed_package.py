"""Plugins that are installed packages, written by tests into a folder of their own."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tests.plugin_folder import LAMP_PLUGIN

BLUEPRINT: dict[str, Any] = {
    "LAMP": {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "State_0": {"Op_on": "State_1"},
        "State_1": {"Op_off": "State_0"},
    }
}
"""A blueprint for the world ``lamp``."""

GOOD, EVIL = 'TAG = "good"\n', 'TAG = "evil"\n'
"""Two texts of the module ``tag``, equally long."""

_TOLD = '        print("built by", TAG)\n'
CODE = "from lamp_pack.tag import TAG\n" + LAMP_PLUGIN.replace('        print("built")\n', _TOLD)


def write_package(site: Path, code: Path | None = None, *listed: str) -> Path:
    """Install the package ``lamp_pack``, whose world says who built it; return its folder.

    Its modules lie in ``site``, or in ``code`` where an editable package has them. ``listed`` are
    further files that it lists.
    """
    folder = (code or site) / "lamp_pack"
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text(CODE, "utf-8")
    (folder / "tag.py").write_text(GOOD, "utf-8")
    info = site / "lamp_pack-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: lamp-pack\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[smsl_studio.plugins]\nlamp = lamp_pack:register\n")
    files = [*listed, *(f"{info.name}/{name}" for name in ("METADATA", "entry_points.txt"))]
    if code is None:
        files += ["lamp_pack/__init__.py", "lamp_pack/tag.py"]
    else:
        (site / "lamp_pack.pth").write_text(f"{code}\n", "utf-8")
        files.append("lamp_pack.pth")
    (info / "RECORD").write_text("".join(f"{file},,\n" for file in files), "utf-8")
    return folder
