"""What plugins offer is known without running their code here, whatever their code does."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from smsl_studio.errors import HostError
from smsl_studio.host.describing import Elsewhere, describe
from smsl_studio.library.loading import Loaded, discover
from tests.plugin_folder import write_plugin

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
            assert isinstance(ours.function, Elsewhere)
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
