"""Functions that are missing: by hand, read, allowed, swept, offered; and those that are not."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.front.inputs import read as read_file
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.bindings import bind
from tests.cases import case
from tests.cli.shell import Answer, Shell
from tests.plugin_folder import write_plugin

KITCHEN = """
import ctypes
import os
import tempfile

OPEN = ctypes.CDLL(None).open


class Kitchen:
    def __init__(self):
        self.full = self.hot = "0"

    def heat(self):
        self.hot = "1"

    def open_door(self, path):
        return open(path).read()

    def call(self):
        import socket
        socket.create_connection(("127.0.0.1", 9))

    def start(self):
        import subprocess
        subprocess.run(["true"])

    def write(self, path):
        try:
            open(path, "w").close()
        except BaseException:
            pass

    def around(self, path):
        # No event of Python tells of this: only the kernel can refuse it.
        if OPEN(path.encode(), os.O_CREAT | os.O_WRONLY, 0o600) < 0:
            raise OSError("the kernel refuses it")


def register(library):
    @library.world("kitchen", engine="table", settle=0.1)
    def build(world, blueprint, seed):
        return Kitchen()

    @library.arrange("kitchen")
    def arrange(kitchen, facts):
        tempfile.TemporaryFile().close()  # as engines do that build a robot
        kitchen.full, kitchen.hot = facts[("CUP", 0)], facts[("CUP", 1)]

    @library.sensor("full", fact="CUP/1", period=0.05)
    def full(kitchen):
        return kitchen.full

    @library.sensor("hot", fact="CUP/2", period=0.05)
    def hot(kitchen):
        return kitchen.hot

    @library.operation("Op_fill", timeout=5.0)
    def fill(kitchen):
        yield
        kitchen.full = "1"
"""
CUP = {
    "CUP": {
        "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2},
        "State_00": {"Op_fill": "State_10", "Op_serve": "State_11"},
        "State_10": {"Op_heat": "State_11"},
        "State_11": {},
    }
}
HEAT = "def op_heat(world):\n    yield\n    world.heat()\n"
LIFT = """
def op_lift_small(world):
    for _ in range(10):
        yield
    return (yield from do(world, "Op_1b"))
"""


class Kitchen:
    """A blueprint of two missing functions, and a person with a command line."""

    def __init__(self, shell: Shell, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        write_plugin(folder / "worlds", "kitchen", KITCHEN)
        monkeypatch.setenv("SMSL_PLUGIN_PATH", str(folder / "worlds"))
        self._shell, self._folder = shell, folder
        self.file = folder / "cup.json"
        self.file.write_text(json.dumps(CUP))
        self.rmm = folder / "made" / "rmm"

    def written(self, **codes: str) -> Answer:
        """Write functions by hand, and let them be checked."""
        hand = self._folder / "hand" / "rmm"
        hand.mkdir(parents=True, exist_ok=True)
        for name, code in codes.items():
            (hand / f"CUP.{name}.py").write_text(code)
        out = self._folder / "made" / "cup.json"
        return self._shell(
            "generate", "text", str(self.file), "--by-hand", str(hand.parent), "-o", str(out)
        )

    def allowed(self) -> Answer:
        """Read what waits, and allow just this."""
        told = self._shell("plugins", "allow", str(self.rmm), "--format", "json")
        assert told.status == 1, told.err
        return self._shell("plugins", "allow", str(self.rmm), "--read", told.json["digest"])

    def swept(self, *words: str) -> Answer:
        return self._shell("sweep", str(self.file), "--world", "kitchen", *words)

    def ran(self, *words: str) -> Answer:
        goal = ("--goal", "State_11", "--format", "json")
        return self._shell("run", str(self.file), "--world", "kitchen", *goal, *words)


@pytest.fixture
def kitchen(shell: Shell, home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Kitchen:
    return Kitchen(shell, tmp_path, monkeypatch)


def offered(answer: Any) -> bool:
    return "is offered in kitchen" in answer.err


def test_a_missing_function_is_asked_read_allowed_swept_and_offered(
    kitchen: Kitchen, shell: Shell, home: Path
) -> None:
    made = kitchen.written(Op_heat=HEAT)
    assert made.status == 0, made.err
    assert "2 operations have no function" in made.err
    shown = shell("plugins", "allow", str(kitchen.rmm))
    assert (shown.status, "+    world.heat()" in shown.out) == (1, True)
    assert "it is not loaded" in shown.err
    assert not (home / "plugins").exists()
    other = shell("plugins", "allow", str(kitchen.rmm), "--read", "0" * 12)
    assert (other.status, "is not what was read" in other.err) == (2, True)
    done = kitchen.allowed()
    assert (done.status, "CUP/Op_heat: offered once" in done.out) == (0, True)
    assert "Op_serve" not in done.out  # its file is a skeleton
    waits = kitchen.ran()
    assert waits.lines[-1]["reason"] == "no_route"
    assert "it has not passed its sweep in kitchen" in waits.err
    tried = kitchen.swept("--operation", "Op_heat")
    assert (tried.status, offered(tried)) == (0, True)
    ran = kitchen.ran()
    assert ran.lines[-1]["reason"] == "goal_reached"
    assert "GENERATED FUNCTIONS: CUP/Op_heat" in ran.err
    assert "CUP/Op_heat: offered in kitchen" in shell("plugins").out
    same = shell("plugins", "allow", str(kitchen.rmm))
    assert same.out == "rmm_cup: allowed, nothing has changed\n"
    copy = home / "plugins" / "rmm_cup" / "CUP.Op_heat.py"
    kept = copy.read_text()
    copy.write_text(f"{kept}    yield\n")
    unread = shell("plugins", "allow", "rmm_cup")
    assert (unread.status, "nobody has read this difference" in unread.err) == (2, True)
    assert "its files have changed since it was allowed" in shell("plugins").out
    copy.write_text(kept)
    alone = kitchen.ran("--host", "local")
    assert alone.lines[-1]["reason"] == "no_route"
    assert "run in a process of their own alone" in alone.err
    # Other code is another function: it is read, allowed and swept anew.
    assert kitchen.written(Op_heat=f"{HEAT}    yield\n").status == 0
    changed = shell("plugins", "allow", str(kitchen.rmm))
    assert [line for line in changed.out.splitlines() if line[:1] == "+"][1:] == ["+    yield"]
    assert kitchen.allowed().status == 0
    assert kitchen.ran().lines[-1]["reason"] == "no_route"


def test_a_missing_move_of_hanoi_is_swept_in_physics(
    shell: Shell, home: Path, tmp_path: Path
) -> None:
    """One edge, so one sweep of three simulated seconds. The code uses what its world can do."""
    file, out = tmp_path / "towers.json", tmp_path / "made" / "towers.json"
    header = {"INITIAL": "State_aa", "ACTIVATING": "State_ba", "NUM_FACTS": 2}
    states = {"State_aa": {"Op_LiftSmall": "State_ba"}, "State_ba": {}}
    file.write_text(json.dumps({"SB1": {"HEADER": header, **states}}))
    hand = tmp_path / "hand"
    words = ("generate", "text", str(file), "--by-hand", str(hand), "-o", str(out))
    asked = shell(*words)
    assert (asked.status, "rmm is missing" in asked.err) == (1, True)
    question = (hand / "rmm.prompt.md").read_text()
    assert "State_aa -> State_ba: fact 1 from a to b" in question
    assert "world hanoi, hanoi-mujoco: Op_{disk}{peg}" in question
    (hand / "rmm").mkdir()
    (hand / "rmm" / "SB1.Op_LiftSmall.py").write_text(LIFT)
    assert shell(*words).status == 0
    told = shell("plugins", "allow", str(out.parent / "rmm"), "--format", "json").json
    read = ("--read", str(told["digest"])[:12])
    assert shell("plugins", "allow", str(out.parent / "rmm"), *read).status == 0
    swept = shell("sweep", str(out), "--world", "hanoi")
    assert (swept.status, "is offered in hanoi" in swept.err) == (0, True)
    loaded = describe()
    assert set(bind(read_file(out), loaded, "hanoi").operations) == {
        Address("SB1", "State_aa", "Op_LiftSmall")
    }
    assert not bind(read_file(out), loaded, "hanoi-mujoco").operations


def test_code_that_fails_its_sweep_or_reaches_out_is_not_offered(
    kitchen: Kitchen, tmp_path: Path
) -> None:
    """One blueprint with an operation for each kind of bad code, and one sweep of them all."""
    bait = tmp_path / "bait"
    bait.write_text("bait")
    bodies = {
        "pass": "",
        "return False": "says that it failed",
        f"world.open_door('{bait}')": f"it opens a file (open {bait})",
        "world.call()": "it asks the network",
        "world.start()": "it starts a process",
        f"world.write('{bait}.new')": f"it opens a file (open {bait}.new)",
        f"world.around('{bait}.c')": "the kernel refuses it",
        "do(world, 'Op_fly')": "has no operation 'Op_fly'",
    }
    names = [f"Op_{number}" for number in range(len(bodies))]
    cup = CUP["CUP"] | {"State_10": dict.fromkeys(names, "State_11")}
    kitchen.file.write_text(json.dumps({"CUP": cup}))
    codes = {}
    for name, body in zip(names, bodies, strict=True):
        done = "" if body == "pass" else "\n    world.heat()"
        codes[name] = f"def {name.lower()}(world):\n    yield\n    {body}{done}\n"
    assert kitchen.written(**codes).status == 0
    assert kitchen.allowed().status == 0
    tried = kitchen.swept(*(word for name in names for word in ("--operation", name)))
    assert (tried.status, offered(tried)) == (1, False)
    for name, (body, words) in zip(names, bodies.items(), strict=True):
        with case("code", body):
            told = f"of CUP/{name} is not offered in kitchen: CUP/State_10/{name}: "
            (line,) = [one for one in tried.err.splitlines() if told in one]
            assert words in line
    ran = kitchen.ran()
    assert (ran.lines[-1]["reason"], "it failed its sweep" in ran.err) == ("no_route", True)
    assert bait.read_text() == "bait"
    assert [one.name for one in tmp_path.iterdir() if one.name.startswith("bait")] == ["bait"]


def test_code_that_says_what_it_may_not_is_never_allowed(
    kitchen: Kitchen, shell: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = kitchen.written(Op_heat="import os\ndef op_heat(world):\n    yield\n")
    assert (told.status, "CUP/Op_heat: line 1: it imports os" in told.err) == (1, True)
    assert kitchen.written(Op_heat=HEAT).status == 0
    file = kitchen.rmm / "CUP.Op_heat.py"
    kept = file.read_text()
    file.write_text(f"{kept}    break\n")
    refused = shell("plugins", "allow", str(kitchen.rmm))
    assert (refused.status, "CUP.Op_heat.py:7:1: the code is no Python" in refused.err) == (2, True)
    file.write_text(f"{kept}    open('/etc/passwd')\n")
    refused = shell("plugins", "allow", str(kitchen.rmm))
    assert refused.status == 2
    assert "CUP.Op_heat.py:7:1: it asks for open" in refused.err
    (kitchen.rmm / "plugin.py").write_text("print('ran')\n")
    file.write_text(HEAT)
    refused = shell("plugins", "allow", str(kitchen.rmm))
    assert (refused.status, "plugin.py is no generated function" in refused.err) == (2, True)
    # Nothing of the folder is loaded from where it lies, also if it is named as one of plugins.
    (kitchen.rmm / "plugin.py").unlink()
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(kitchen.rmm))
    listed = shell("plugins", "--format", "json").json
    (fault,) = listed["faults"]
    assert "are loaded from the user's folder" in fault["message"]
    assert "rmm_cup" not in [one["name"] for one in listed["plugins"]]
