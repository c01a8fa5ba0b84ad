"""Exactly the digested code is imported, and the digest covers every file of the folder."""

from __future__ import annotations

import os
import py_compile
import socket
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import pytest

from smsl_studio.errors import PluginError
from smsl_studio.library import sources
from smsl_studio.library.loading import discover
from smsl_studio.library.ownership import exposure_on_the_way
from smsl_studio.library.permission import allow
from smsl_studio.library.plugin_package import import_plugin
from smsl_studio.library.sources import check_sources, read_sources
from tests.plugin_folder import found_plugin, write_allowed, write_plugin

CODE = """
from .words import NAME
from .inner.deep import DEEP

def register(library): ...
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr("sys.dont_write_bytecode", False)
    place = write_plugin(tmp_path, "lamp", CODE, words="NAME = 'before'")
    (place / "inner").mkdir()
    (place / "inner" / "deep.py").write_text("from ..words import NAME as DEEP")
    return place


CHANGES: dict[str, Callable[[Path], object]] = {
    "a byte": lambda f: (f / "words.py").write_text("NAME = 'later!'"),
    "a file more": lambda f: (f / "mesh.obj").write_bytes(b""),
    "a file less": lambda f: (f / "words.py").unlink(),
    "another name": lambda f: (f / "words.py").rename(f / "world.py"),
    "moved": lambda f: (f / "words.py").rename(f / "inner" / "words.py"),
    "a link": lambda f: (f / "alias.py").symlink_to("words.py"),
    "the manifest": lambda f: (f / "plugin.toml").write_text('name = "lamp"\nversion = "2"\n'),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_every_change_is_another_digest(folder: Path, change: Callable[[Path], object]) -> None:
    before = read_sources(folder).digest
    assert read_sources(folder).digest == before
    change(folder)
    assert read_sources(folder).digest != before


def test_compiled_copies_are_beside_the_digest(folder: Path) -> None:
    before = read_sources(folder).digest
    import_plugin("lamp", folder)
    assert (folder / "__pycache__").is_dir()
    assert read_sources(folder).digest == before


def test_what_was_digested_is_imported_whatever_the_disk_says_by_then(folder: Path) -> None:
    import_plugin("lamp", folder)  # leaves compiled copies
    found = read_sources(folder)
    (folder / "words.py").write_text("NAME = 'exchanged'")
    (folder / "inner" / "deep.py").unlink()
    (folder / "plugin.py").write_text("raise SystemExit")
    module = import_plugin("lamp", folder, found)
    assert (module.NAME, module.DEEP) == ("before", "before")
    (folder / "late.py").write_text("")
    with pytest.raises(ModuleNotFoundError, match="late"):
        import_module(".late", module.__name__)


def test_a_compiled_copy_that_was_exchanged_is_not_run(folder: Path) -> None:
    import_plugin("lamp", folder)
    found = read_sources(folder)
    (copy,) = (folder / "__pycache__").glob("words.*.pyc")
    other = folder.parent / "other.py"
    other.write_text("NAME = 'exchan'")
    times = (folder / "words.py").stat()
    os.utime(other, ns=(times.st_atime_ns, times.st_mtime_ns))
    assert other.stat().st_size == times.st_size
    py_compile.compile(str(other), cfile=str(copy), doraise=True)
    assert import_plugin("lamp", folder).NAME == "exchan", "the copy is what Python believes"
    assert import_plugin("lamp", folder, found).NAME == "before"


def test_between_two_loads_nothing_of_the_first_stays(folder: Path) -> None:
    import_plugin("lamp", folder, read_sources(folder))
    (folder / "words.py").write_text("NAME = 'after'")
    assert import_plugin("lamp", folder, read_sources(folder)).NAME == "after"


def _socket(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(str(path))


FAULTS: dict[str, tuple[Callable[[Path], object], str]] = {
    "a link that leads out": (lambda f: (f / "out.py").symlink_to("../x.py"), "leads out"),
    "a link to a folder outside": (lambda f: (f / "out").symlink_to("/usr"), "leads out"),
    "a link in a circle": (lambda f: (f / "loop").symlink_to("loop"), "leads out"),
    "a socket": (lambda f: _socket(f / "hole.py"), "hole.py is no ordinary file"),
    "a pipe": (lambda f: os.mkfifo(f / "pipe.py"), "pipe.py is no ordinary file"),
}


@pytest.mark.parametrize(("make", "words"), FAULTS.values(), ids=FAULTS)
def test_what_cannot_be_digested_is_told(
    folder: Path, make: Callable[[Path], object], words: str
) -> None:
    (folder.parent / "x.py").write_text("")
    make(folder)
    with pytest.raises(PluginError, match=words):
        read_sources(folder)


def test_a_folder_that_holds_too_much_is_told(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sources, "MOST_BYTES", 100)
    with pytest.raises(PluginError, match="more than 0 MB"):
        read_sources(folder)
    monkeypatch.setattr(sources, "MOST_FILES", 3)
    with pytest.raises(PluginError, match="more than 3 files"):
        read_sources(folder)


def test_a_link_out_of_a_folder_that_was_named_leads_to_what_is_the_users_own(
    folder: Path,
) -> None:
    shared = folder.parent / "shared"
    shared.mkdir()
    (shared / "x.py").write_text("")
    (folder / "shared").symlink_to(shared)
    check_sources(folder)
    (shared / "x.py").chmod(0o666)
    with pytest.raises(PluginError, match=r"shared/x.py may be written by everybody"):
        check_sources(folder)


def test_a_link_on_the_way_is_looked_at_with_what_it_leads_through(folder: Path) -> None:
    through = folder.parent / "through"
    through.mkdir()
    (through / "link").symlink_to(folder)
    (folder.parent / "first").symlink_to(Path("through") / ".." / "through" / "link")
    assert exposure_on_the_way(folder.parent / "first") is None
    through.chmod(0o777)
    exposed = exposure_on_the_way(folder.parent / "first")
    assert exposed is not None
    assert exposed.path == through


def test_what_was_seen_is_allowed_and_not_what_stands_there_by_then(home: Path) -> None:
    place = write_plugin(home / "plugins", "lamp", CODE)
    seen = found_plugin("lamp")
    (place / "words.py").write_text("raise SystemExit")
    allow(seen)
    loaded = discover()
    assert "lamp" not in [plugin.name for plugin in loaded.plugins]
    assert [(found.name, found.state.value) for found in loaded.waiting] == [("lamp", "changed")]


def test_what_people_were_shown_is_all_that_is_registered(home: Path) -> None:
    code = """
    def register(library):
        @library.world("hidden", engine="table")
        def build(world, blueprint, seed): ...
    """
    place = write_plugin(home / "plugins", "lamp", code)
    (place / "plugin.toml").write_text('name = "lamp"\nworlds = ["lamp"]\n')
    allow(found_plugin("lamp"))
    (fault,) = discover().faults
    assert "it registers 'hidden', which is not among the worlds" in fault.sentence


def test_an_allowed_plugin_of_several_files_loads(home: Path) -> None:
    write_allowed(
        home, "lamp", "from .words import NAME\ndef register(library): ...", words="NAME = 1"
    )
    assert "lamp" in [plugin.name for plugin in discover().plugins]
