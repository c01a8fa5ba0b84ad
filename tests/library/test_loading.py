"""Plugins are found in order. A broken plugin is one fault with its line and stops no other."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from smsl_studio.errors import WorldError
from smsl_studio.library.loaded import PluginFault
from smsl_studio.library.loading import discover
from tests.plugin_folder import LAMP_PLUGIN, write_allowed, write_plugin

GOOD = """
from .words import NAME

def register(library):
    @library.world(NAME, engine="table")
    def build(world, blueprint, seed): ...
"""

BROKEN = {
    "syntax": ("def register(library)\n    pass\n", 1, "SyntaxError"),
    "importing": ("\nimport no_such_module\n", 2, "ModuleNotFoundError"),
    "exiting": ("import sys\nsys.exit(3)\n", 2, "SystemExit: 3"),
    "panicking": ("class Panic(BaseException): ...\nraise Panic('boom')\n", 2, "Panic: boom"),
    "registering": ("def register(library):\n    x = 1\n    raise ValueError('boom')\n", 3, "boom"),
    "deeper": ("def f():\n    return 1 / 0\n\ndef register(library):\n    f()\n", 2, "Zero"),
    "nothing": ("x = 1\n", 1, "no function register"),
    "no_generator": (
        "def register(library):\n    @library.operation('Op')\n    def f(world): ...\n",
        2,
        "no generator function",
    ),
    "no_world": (
        "def register(library):\n    @library.operation('Op')\n    def f():\n        yield\n",
        2,
        "does not take the world",
    ),
    "unnamed": (
        "def register(library):\n"
        "    @library.operation('Op_{disk}')\n"
        "    def f(world, disk: int, peg: str):\n        yield\n",
        2,
        "needs 'peg'",
    ),
    "unknown_engine": (
        "def register(library):\n    @library.world('w', engine='unreal')\n    def b(*a): ...\n",
        2,
        "engine is 'unreal'",
    ),
    "the_table": (
        "def register(library):\n    @library.world('table')\n    def b(*a): ...\n",
        2,
        "taken",
    ),
}


def _faults(folder: Path) -> dict[str, PluginFault]:
    return {fault.plugin: fault for fault in discover([folder]).faults}


def test_broken_plugins_are_named_with_their_lines_and_stop_nobody(tmp_path: Path) -> None:
    for name, (code, _, _) in BROKEN.items():
        write_plugin(tmp_path, name, code)
    write_plugin(tmp_path, "zgood", GOOD, words='NAME = "good"')
    loaded = discover([tmp_path])
    assert "good" in loaded.worlds
    faults = {fault.plugin: fault for fault in loaded.faults}
    assert faults.keys() == BROKEN.keys()
    for name, (_, line, words) in BROKEN.items():
        place = faults[name].place
        assert place is not None, name
        assert (Path(place.file).name, place.line) == ("plugin.py", line), name
        assert words in faults[name].sentence, faults[name].sentence


def test_a_world_that_is_not_there_names_the_plugins_that_did_not_load(tmp_path: Path) -> None:
    write_plugin(tmp_path, "bad", "def register(library)\n")
    write_plugin(tmp_path, "zgood", GOOD, words='NAME = "good"')
    loaded = discover([tmp_path])
    with pytest.raises(WorldError, match="the plugin 'bad' did not load"):
        loaded.world("kitchen")
    with pytest.raises(WorldError) as near:
        loaded.world("goood")
    assert "bad" not in str(near.value)


def test_a_fault_in_a_sibling_module_names_the_sibling(tmp_path: Path) -> None:
    write_plugin(tmp_path, "bad", GOOD, words="\n\nNAME = 1 / 0\n")
    (fault,) = discover([tmp_path]).faults
    assert fault.place is not None
    assert (Path(fault.place.file).name, fault.place.line) == ("words.py", 3)


@pytest.mark.parametrize(
    ("manifest", "line", "words"),
    [
        ('name = "x', 1, "TOML"),
        ('version = "1"', 1, "name"),
        ('version = "1"\nname = "Not A Name"', 2, "name"),
        ('name = "x"\nicons = 3', 2, "icons"),
        ("x = " + "[" * 50_000, 1, "nested too deeply"),
        ("x = " + "9" * 50_000, 1, "4300 digits"),
        ("#" * 400_001, 1, "longer than 400000 bytes"),
    ],
)
def test_a_broken_manifest_is_named_with_its_line(
    tmp_path: Path, manifest: str, line: int, words: str
) -> None:
    write_plugin(tmp_path, "x", GOOD, words='NAME = "w"')
    (tmp_path / "x" / "plugin.toml").write_text(manifest, "utf-8")
    (fault,) = discover([tmp_path]).faults
    assert fault.place is not None
    assert (Path(fault.place.file).name, fault.place.line) == ("plugin.toml", line)
    assert words in fault.sentence


def test_a_folder_without_code_is_a_fault(tmp_path: Path) -> None:
    place = write_plugin(tmp_path, "empty", "")
    (place / "plugin.py").unlink()
    assert "no plugin.py" in _faults(tmp_path)["empty"].sentence


def test_code_without_a_manifest_is_a_fault(tmp_path: Path) -> None:
    place = write_plugin(tmp_path, "bare", GOOD)
    (place / "plugin.toml").unlink()
    (tmp_path / "notes").mkdir()
    faults = _faults(tmp_path)
    assert faults.keys() == {"bare"}
    assert "no plugin.toml" in faults["bare"].sentence


def test_plugins_are_found_in_the_path_and_at_home(
    tmp_path: Path, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = write_plugin(tmp_path / "a", "one", GOOD, words='NAME = "w1"')
    write_plugin(tmp_path / "b", "two", GOOD, words='NAME = "w2"')
    write_allowed(home, "three", GOOD, words='NAME = "w3"')
    monkeypatch.setenv("SMSL_PLUGIN_PATH", f"{one}:{tmp_path / 'b'}:{tmp_path / 'nowhere'}")
    loaded = discover()
    assert [(p.name, p.source) for p in loaded.plugins[:3]] == [
        ("one", "SMSL_PLUGIN_PATH"),
        ("two", "SMSL_PLUGIN_PATH"),
        ("three", "user"),
    ]
    assert {"table", "w1", "w2", "w3", "hanoi"} <= set(loaded.worlds)
    assert [fault.plugin for fault in loaded.faults] == ["nowhere"]


def test_a_folder_with_no_possible_name_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SMSL_PLUGIN_PATH", f"{'x' * 300}:~nobody-of-this-name/plugins")
    faults = discover().faults
    assert [fault.sentence for fault in faults] == [
        "File name too long",
        "No such file or directory",
    ]


def test_of_two_plugins_with_one_name_the_first_is_taken(tmp_path: Path) -> None:
    first = write_plugin(tmp_path / "a", "twin", GOOD, words='NAME = "w1"')
    write_plugin(tmp_path / "b", "twin", GOOD, words='NAME = "w2"')
    loaded = discover([tmp_path / "a", tmp_path / "b", tmp_path / "a"])
    assert loaded.world("w1")[0].location == str(first)
    (fault,) = loaded.faults
    assert str(first) in fault.sentence


def test_a_world_has_one_owner(tmp_path: Path) -> None:
    write_plugin(tmp_path, "a", GOOD, words='NAME = "w"')
    write_plugin(tmp_path, "b", GOOD, words='NAME = "w"')
    assert "taken by the plugin 'a'" in _faults(tmp_path)["b"].sentence


def test_plugins_do_not_see_each_other_and_leave_the_path_alone(tmp_path: Path) -> None:
    before = list(sys.path)
    write_plugin(tmp_path, "a", GOOD, words='NAME = "wa"')
    write_plugin(tmp_path, "b", GOOD, words='NAME = "wb"')
    assert {"wa", "wb"} <= set(discover([tmp_path]).worlds)
    assert sys.path == before
    assert "words" not in sys.modules


def test_an_edited_plugin_is_read_anew(tmp_path: Path) -> None:
    place = write_plugin(tmp_path, "a", GOOD, words='NAME = "before"')
    assert "before" in discover([tmp_path]).worlds
    (place / "words.py").write_text('NAME = "after it all"', "utf-8")
    assert "after it all" in discover([tmp_path]).worlds


def test_what_a_plugin_prints_is_no_data(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_plugin(tmp_path, "loud", "print('hello')\ndef register(library): print('you')")
    discover([tmp_path])
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "hello\nyou\n")


def test_an_installed_package_is_a_plugin(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "lamp_module.py").write_text(LAMP_PLUGIN, "utf-8")
    info = tmp_path / "lamp_plugin-1.5.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: lamp-plugin\nVersion: 1.5\n")
    (info / "entry_points.txt").write_text(
        "[smsl_studio.plugins]\nlamp = lamp_module\ngone = no_such_module\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    loaded = discover()
    plugin, _ = loaded.world("lamp")
    assert (plugin.version, plugin.source) == ("1.5", "installed")
    assert [fault.plugin for fault in loaded.faults] == ["gone"]


def test_an_unknown_world_has_a_near_name() -> None:
    with pytest.raises(WorldError) as caught:
        discover().world("hanio")
    assert caught.value.advice == "Did you mean hanoi?"


def test_an_unknown_world_names_the_broken_plugin(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", "1 / 0")
    with pytest.raises(WorldError, match="ZeroDivisionError"):
        discover([tmp_path]).world("lamp")
