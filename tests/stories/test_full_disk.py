"""A full disk: the old file stays, the window says so, and the work can go on."""

from __future__ import annotations

import json
import resource
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from smsl_studio.blueprint import editing
from tests.stories.conftest import Sit

SIZE = 128 << 10
Crowded = tuple[Path, Callable[[], None]]


@pytest.fixture
def crowded(tmp_path: Path) -> Iterator[Crowded]:
    """A folder on a small disk, and what makes room there.

    Where no disk can be mounted, files may not be long instead.
    """
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={SIZE}", "none", str(folder)]
    if subprocess.run(mount, capture_output=True, check=False).returncode == 0:
        filler = folder / "filler"
        filler.write_bytes(bytes(SIZE // 2))
        yield folder, filler.unlink
        subprocess.run(["umount", str(folder)], check=True)
        return
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (SIZE // 4, before[1]))
    yield folder, lambda: resource.setrlimit(resource.RLIMIT_FSIZE, before)
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_a_full_disk_is_told_and_the_old_file_survives(sit: Sit, crowded: Crowded) -> None:
    folder, make_room = crowded
    path = folder / "large.json"
    states = {f"State_{number:04}": {"Op": "State_0000"} for number in range(800)}
    path.write_text(json.dumps({"SB1": states}))
    before = path.read_bytes()
    assert SIZE // 5 < len(before) < SIZE // 3
    person = sit(path)
    note = "x" * (SIZE // 3)
    person.window.session.edit(
        "Note", lambda bp: editing.set_note(bp, "SB1", "_states", "State_0000", {"note": note})
    )
    assert not person.window.files.save()
    assert "large.json was not saved" in person.window.toast.words
    assert "still stands" in person.window.toast.words
    assert path.read_bytes() == before
    assert person.window.menu_row.title == "large.json edited"
    assert [found.name for found in folder.iterdir() if found.name.startswith(".")] == []
    make_room()
    assert person.window.files.save()
    assert note in path.read_text()
    assert person.window.menu_row.title == "large.json"
