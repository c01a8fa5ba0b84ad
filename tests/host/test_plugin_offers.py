"""The offers of plugins are found without running their code in this process, even if it fails."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from pathlib import Path
from textwrap import dedent

import pytest

from smsl_studio.errors import HostError
from smsl_studio.host.confinement import keeps_apart
from smsl_studio.host.description import AbsentCode
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.loading import discover
from smsl_studio.stop import StopListener, Stopped, heeding
from tests.plugin_folder import SHIPPED, write_plugin
from tests.processes import child_processes

GOOD = """
class Odd:
    pass

def register(library):
    @library.world("good", engine="table")
    def build(world, blueprint, seed):
        return None

    @library.arrange("good")
    def put(world, facts):
        pass

    @library.sensor("eye_{n}", fact="{n}", words={"h": "held"})
    def eye(world, n: int):
        return None

    @library.operation("Go_{n}{to}", timeout=3.0)
    def go(world, n: int, to: str, odd: Odd = None):
        yield
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "home"))
    (tmp_path / "plugins").mkdir()
    return tmp_path / "plugins"


def _named(loaded: Loaded) -> dict[str, str]:
    return {fault.plugin: fault.sentence for fault in loaded.faults}


def test_a_description_is_what_loading_finds_without_the_code(folder: Path) -> None:
    write_plugin(folder, "good", GOOD)
    told, loaded = describe([folder]), discover([folder])
    assert [p.name for p in told.plugins] == [p.name for p in loaded.plugins]
    assert told.worlds == loaded.worlds
    assert not told.faults
    for here, there in zip(told.plugins, loaded.plugins, strict=True):
        for ours, theirs in zip(here.library.operations, there.library.operations, strict=True):
            assert (ours.name, ours.stop, ours.timeout) == (
                theirs.name,
                theirs.stop,
                theirs.timeout,
            )
            assert (ours.pattern and ours.pattern.text) == (theirs.pattern and theirs.pattern.text)
            assert ours.signature.required == theirs.signature.required
            assert isinstance(ours.function, AbsentCode)
    (go,) = told.plugins[0].library.operations
    assert go.pattern is not None
    assert go.pattern.match("Go_12b") == {"n": "12", "to": "b"}
    assert dict(go.signature.types) == {"n": int, "to": str, "odd": object}


def test_code_that_is_elsewhere_cannot_be_called(folder: Path) -> None:
    write_plugin(folder, "good", GOOD)
    (go,) = describe([folder]).plugins[0].library.operations
    with pytest.raises(HostError, match="go is not here"):
        go.function(None)


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("import ctypes; ctypes.string_at(0)", "SIGSEGV"),
        ("import os; os._exit(3)", "exit status 3"),
        ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", "SIGKILL"),
        ("raise SystemExit(2)", "SystemExit: 2"),
        ("import atexit, os; atexit.register(lambda: os._exit(9)); raise OSError('no')", "no"),
    ],
)
def test_a_plugin_that_ends_its_process_is_one_fault(folder: Path, code: str, words: str) -> None:
    write_plugin(folder, "bad", code)
    write_plugin(folder, "good", GOOD)
    told = describe([folder])
    assert "good" in told.worlds
    assert words in _named(told)["bad"]


def test_a_plugin_that_never_ends_loading_is_one_fault(folder: Path) -> None:
    write_plugin(folder, "bad", "while True: pass")
    write_plugin(folder, "good", GOOD)
    told = describe([folder], limit=1.0)
    assert "good" in told.worlds
    assert _named(told)["bad"] == "it did not load within 1 s"


def test_what_a_plugin_prints_stays_out_of_our_output(
    folder: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    write_plugin(folder, "good", "import os\nos.write(1, b'noise')\nprint('noise')\n" + GOOD)
    assert "good" in describe([folder]).worlds
    assert capfd.readouterr().out == ""


def test_nothing_of_a_plugin_runs_here(folder: Path) -> None:
    told_in = folder.parent / "process"
    code = f"import os, pathlib\npathlib.Path({str(told_in)!r}).write_text(str(os.getpid()))\n"
    write_plugin(folder, "good", code + GOOD)
    describe([folder])
    assert int(told_in.read_text()) != os.getpid()


def test_a_plugin_that_prints_without_end_is_cut_short(
    folder: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    loud = GOOD.replace("def register(library):", "def register(library):\n    print('x' * 10**7)")
    write_plugin(folder, "good", loud)
    assert "good" in describe([folder]).worlds
    said = capfd.readouterr()
    assert not said.out
    assert 1_000_000 <= len(said.err) < 1_001_000
    assert "... more is printed" in said.err


def test_nothing_in_the_current_folder_is_imported(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("json", "pickle", "socket", "struct", "smsl_studio", "encodings"):
        (folder / f"{name}.py").write_text("raise SystemExit('read from the current folder')")
    monkeypatch.chdir(folder)
    monkeypatch.setattr("sys.path", [one for one in sys.path if one])
    assert [plugin.name for plugin in describe().plugins] == [*SHIPPED]


@pytest.mark.parametrize(
    "forging",
    [
        "library.name = 'hanoi'",
        "module.Plugin = lambda name, *others: plugin('hanoi', *others)",
    ],
)
def test_a_plugin_cannot_take_another_name_once_it_runs(folder: Path, forging: str) -> None:
    code = f"""
    import smsl_studio.library.loading as module

    def register(library, plugin=module.Plugin):
        {forging}
    """
    write_plugin(folder, "bad", code)
    told = describe([folder])
    assert [plugin.name for plugin in told.plugins] == [*SHIPPED]
    assert _named(told) == {"bad": "it calls itself 'hanoi' once it runs"}


def test_a_stop_ends_all_that_load(folder: Path) -> None:
    pids = folder.parent / "pids"
    code = f"import os\nwith open({str(pids)!r}, 'a') as file:\n    print(os.getpid(), file=file)\n"
    for number in range(4):
        write_plugin(folder, f"endless_{number}", code + "while True: pass")
    pids.touch()

    def listener() -> None:
        if len(pids.read_text().split()) == 4:
            raise Stopped

    with heeding(listener), pytest.raises(Stopped):
        describe([folder], together=4)
    until = time.monotonic() + 20
    while any(Path(f"/proc/{pid}").exists() for pid in pids.read_text().split()):
        assert time.monotonic() < until


MEETING = """
import os, pathlib, time
here = pathlib.Path({place!r})
(here / str(os.getpid())).touch()
while len(list(here.iterdir())) < {many}:
    time.sleep(0.01)
def register(library):
    pass
"""


def test_plugins_load_at_the_same_time(folder: Path) -> None:
    """Each of the five waits until all have begun; one after the other, none would load."""
    place = folder.parent / "met"
    place.mkdir()
    for number in range(5):
        write_plugin(folder, f"one_{number}", MEETING.format(place=str(place), many=5))
    told = describe([folder], together=2)
    assert not told.faults
    assert len(told.plugins) == 5 + len(SHIPPED)


@pytest.mark.parametrize("together", [0, 1, 3])
def test_plugins_that_hang_stop_no_other_and_are_named_in_order(
    folder: Path, together: int
) -> None:
    for number in range(3):
        write_plugin(folder, f"bad_{number}", "while True: __import__('time').sleep(9)")
    write_plugin(folder, "a_good", "def register(library): pass")
    write_plugin(folder, "z_good", GOOD)
    told = describe([folder], limit=2.5, together=together)
    assert [plugin.name for plugin in told.plugins] == ["a_good", "z_good", *SHIPPED]
    assert [fault.plugin for fault in told.faults] == [f"bad_{number}" for number in range(3)]
    assert {fault.sentence for fault in told.faults} == {"it did not load within 2.5 s"}


VICTIM = """
import os, pathlib, time
pathlib.Path({note!r}).write_text(str(os.getpid()))
while not pathlib.Path({done!r}).exists():
    time.sleep(0.01)
def register(library):
    pass
"""
ATTACKER = """
import os, pathlib, time
note, done = pathlib.Path({note!r}), pathlib.Path({done!r})
while not (note.exists() and note.read_text()):
    time.sleep(0.01)
other, said = int(note.read_text()), []
for what in (
    lambda: os.kill(other, 9),
    lambda: os.kill(other, 19),
    lambda: os.killpg(other, 9),
    lambda: os.kill(-other, 9),
    lambda: open(f"/proc/{{other}}/fd/1", "w"),
    lambda: open(f"/proc/{{other}}/mem", "r+b"),
):
    try:
        what()
        said.append("done")
    except PermissionError:
        said.append("refused")
files = [f"/proc/self/fd/{{one}}" for one in os.listdir("/proc/self/fd") if int(one) > 2]
kinds = [os.readlink(one) for one in files if os.path.lexists(one)]
pathlib.Path({done!r} + ".part").write_text(" ".join(said) + "\\n" + "\\n".join(kinds))
os.rename({done!r} + ".part", done)
def register(library):
    pass
"""


def test_plugins_that_load_at_the_same_time_cannot_reach_each_other(folder: Path) -> None:
    note, done = folder.parent / "note", folder.parent / "done"
    names = {"note": str(note), "done": str(done)}
    write_plugin(folder, "a_victim", VICTIM.format(**names))
    write_plugin(folder, "b_attacker", ATTACKER.format(**names))
    if not keeps_apart():  # then they do not load at the same time
        assert [one.plugin for one in describe([folder], limit=1.0).faults] == ["a_victim"]
        return
    told = describe([folder], together=2)
    assert not told.faults
    said, *files = done.read_text().split("\n")
    assert said.split() == ["refused"] * 6
    assert len([one for one in files if one.startswith("pipe:")]) == 1, "its own pipe alone"
    assert not [one for one in files if "pidfd" in one]


def test_a_confined_plugin_may_do_with_files_what_its_user_may(folder: Path) -> None:
    code = f"""
    import os, pathlib
    here = pathlib.Path({str(folder.parent)!r})
    for name in ("from", "to"):
        (here / name).mkdir()
    (here / "from/file").write_text("x")
    os.rename(here / "from/file", here / "to/file")
    os.link(here / "to/file", here / "from/other")
    def register(library):
        pass
    """
    write_plugin(folder, "mover", code)
    assert not describe([folder]).faults
    assert (folder.parent / "from/other").read_text() == "x"


def test_where_all_are_lost_each_is_asked_again_alone(folder: Path) -> None:
    """Somebody kills the process that starts them: who is to blame shows when each is alone."""
    begun = folder.parent / "begun"
    begun.touch()
    first = f"""
    import os, pathlib, time
    begun = pathlib.Path({str(begun)!r})
    with begun.open("a") as file:
        print(os.getpid(), file=file)
    """
    waits = "if len(begun.read_text().split()) < 3:\n    time.sleep(600)\n"
    write_plugin(folder, "a_exits", f"{dedent(first)}{waits}os._exit(3)\n")
    write_plugin(folder, "b_good", f"{dedent(first)}{waits}def register(library): pass\n")

    def kill() -> None:
        while len(begun.read_text().split()) < 2:
            time.sleep(0.01)
        os.kill(child_processes()[0], signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    told = describe([folder], together=2)
    killer.join()
    assert "b_good" in [plugin.name for plugin in told.plugins]
    assert list(_named(told)) == ["a_exits"]
    assert "exit status 3" in _named(told)["a_exits"]
    until = time.monotonic() + 20
    while any(Path(f"/proc/{pid}").exists() for pid in begun.read_text().split()):
        assert time.monotonic() < until


def test_a_stop_ends_the_describing(folder: Path) -> None:
    write_plugin(folder, "endless", "while True: pass")
    with heeding(StopListener(3).heed), pytest.raises(Stopped):
        describe([folder])
    assert child_processes() == []
