"""Plugin folders whose files alone are hostile, before any of their code could run."""

from __future__ import annotations

import os
from pathlib import Path

GOOD = "def register(library):\n    pass\n"

MANIFESTS: dict[str, tuple[bytes, str]] = {
    "name_climbs": (b'name = "../../escape"\n', "name: String should match pattern"),
    "name_shouts": (b'name = "A"\n', "name: String should match pattern"),
    "name_is_long": (b'name = "' + b"a" * 61 + b'"\n', "name: String should have at most 60"),
    "name_is_missing": (b'version = "1"\n', "name: Field required"),
    "name_stands_twice": (b'name = "a"\nname = "b"\n', "overwrite"),
    "says_more": (b'name = "says_more"\nrun = "rm"\n', "run: Extra inputs"),
    "is_no_text": (b'name = "\xff"\n', "UTF-8|utf-8"),
    "is_deep": (b"name = " + b"[" * 40_000 + b"]" * 40_000, "deep|nest"),
    "is_long": (b"#" * 10**7, "longer than"),
}
"""What stands in ``plugin.toml``, and the words of its one error."""


def write_files(folder: Path) -> dict[str, str]:
    """Write every folder; the words each is known by."""
    words = {}
    for name, (manifest, told) in MANIFESTS.items():
        _write(folder / name, manifest)
        words[name] = told
    for name, file in {
        "code_is_missing": "",
        "code_is_a_pipe": "pipe",
        "code_is_a_folder": "folder",
    }.items():
        place = _write(folder / name, f'name = "{name}"\n'.encode())
        (place / "plugin.py").unlink()
        if file == "pipe":
            os.mkfifo(place / "plugin.py")
        elif file == "folder":
            (place / "plugin.py").mkdir()
        words[name] = "it has no plugin.py"
    for name, target in {"manifest_is_a_pipe": "", "manifest_goes_round": "plugin.toml"}.items():
        place = _write(folder / name, b"")
        (place / "plugin.toml").unlink()
        if target:
            (place / "plugin.toml").symlink_to(target)
        else:
            os.mkfifo(place / "plugin.toml")
        words[name] = "it has no plugin.toml"
    return words


def _write(place: Path, manifest: bytes) -> Path:
    place.mkdir()
    (place / "plugin.toml").write_bytes(manifest)
    (place / "plugin.py").write_text(GOOD)
    return place
