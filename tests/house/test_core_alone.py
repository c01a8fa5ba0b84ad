"""The core works without Qt and PyBullet, and loads no module that it does not need."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from smsl_studio import ApprovalRequest, approve, make_key, read
from smsl_studio.shipped import samples_dir

HEAVY = ("PySide6", "shiboken6", "pybullet", "pyqtgraph", "moderngl", "mujoco", "PIL")

ABSENT = (*HEAVY, "pybullet_data")

BLOCKER = f"""
import sys

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition('.')[0] in {ABSENT!r}:
            raise ModuleNotFoundError(f'No module named {{name!r}}', name=name)

sys.meta_path.insert(0, Absent())
"""

EVERY_CORE_MODULE = """
import importlib, pkgutil, smsl_studio
ENGINES = ("smsl_studio.world.bullet", "smsl_studio.world.mujoco_world")
DOOR = ("smsl_studio.studio", "smsl_studio.__main__", "smsl_studio._shipped")
for module in pkgutil.walk_packages(smsl_studio.__path__, "smsl_studio.", lambda name: None):
    if not module.name.startswith(DOOR) and module.name not in ENGINES:
        importlib.import_module(module.name)
"""

COMMANDS = """
from smsl_studio.__main__ import main
sys.exit(main(sys.argv[1:]))
"""


def python(code: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", code, *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        stdin=subprocess.DEVNULL,
    )


def sample(name: str) -> str:
    return str(samples_dir() / name)


def test_every_core_module_imports_without_them() -> None:
    done = python(BLOCKER + EVERY_CORE_MODULE)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("check", sample("hanoi-corrected.json")), ""),
        (
            ("route", sample("hanoi.json"), "--from", "State_aaa", "--to", "State_ccc"),
            "SB1/State_aaa/Op_1c",
        ),
        (("run", sample("hfsm.json"), "--world", "table"), "goal_reached"),
    ],
    ids=["check", "route", "run"],
)
def test_the_core_works_without_them(arguments: tuple[str, ...], says: str) -> None:
    done = python(BLOCKER + COMMANDS, *arguments)
    assert done.returncode == 0, done.stderr
    assert says in done.stdout
    assert "Traceback" not in done.stderr


def test_a_log_is_told_again_without_them(tmp_path: Path) -> None:
    """And nothing that draws with numpy is loaded for its account."""
    log, page = str(tmp_path / "log"), str(tmp_path / "page.html")
    asked = ("run", sample("hfsm.json"), "--world", "table", "--log", log)
    ran = python(BLOCKER + COMMANDS, *asked)
    again = python(BLOCKER + COMMANDS, "replay", log)
    assert (again.returncode, again.stderr, again.stdout) == (0, "", ran.stdout)
    wider = BLOCKER.replace("'PySide6'", "'PySide6', 'numpy', 'pydantic', 'typst'")
    assert python(wider + COMMANDS, "replay", log, "-o", page).returncode == 0
    assert python(wider + COMMANDS, "replay", log, "--verify").returncode == 0


def test_pictures_are_drawn_without_them(tmp_path: Path) -> None:
    for form in ("svg", "png", "pdf"):
        out = tmp_path / f"picture.{form}"
        done = python(BLOCKER + COMMANDS, "render", sample("hfsm.json"), "-o", str(out))
        assert (done.returncode, done.stderr) == (0, "")
        assert out.stat().st_size > 1000


def test_a_world_whose_engine_is_absent_is_told_and_not_thrown() -> None:
    here = ("--world", "hanoi", "--host", "local")
    done = python(BLOCKER + COMMANDS, "run", sample("hanoi-2.json"), *here)
    assert done.returncode in (1, 2)
    assert "pybullet" in (done.stdout + done.stderr).lower()
    assert "Traceback" not in done.stderr


def test_without_qt_the_window_is_refused_with_a_reason() -> None:
    done = python(BLOCKER + COMMANDS, "open")
    assert done.returncode == 2, done.stderr
    assert "Qt cannot be loaded" in done.stderr


@pytest.mark.parametrize(
    ("code", "unwanted"),
    [
        ("import smsl_studio", (*HEAVY, "scipy", "networkx", "numpy", "pydantic", "typst")),
        ("from smsl_studio import read", (*HEAVY, "scipy", "networkx")),
        ("import smsl_studio.inspection.inspect", (*HEAVY, "scipy", "networkx", "pydantic")),
        ("import smsl_studio.__main__", (*HEAVY, "scipy", "networkx", "argparse", "pydantic")),
    ],
)
def test_an_import_loads_only_what_it_needs(code: str, unwanted: tuple[str, ...]) -> None:
    told = f"{code}\nimport sys\nprint(sorted(set({unwanted!r}) & set(sys.modules)))"
    done = python(told)
    assert (done.stdout.strip(), done.stderr) == ("[]", "")


def test_a_check_loads_neither_what_annotations_need_nor_what_edits_do() -> None:
    unwanted = (
        *("pydantic", "annotated_types", "difflib", "html", "shutil", "hashlib", "decimal"),
        *(f"smsl_studio.{name}" for name in ("blueprint.annotations", "blueprint.editing.draft")),
        *(f"smsl_studio.smsl.{name}" for name in ("disk", "outputs", "pending_saves")),
    )
    told = f"""
import sys
before = set(sys.modules)
from smsl_studio.__main__ import main
status = main(sys.argv[1:])
print(sorted(set({unwanted!r}) & set(sys.modules) - before), file=sys.stderr)
sys.exit(status)
"""
    done = python(told, "check", sample("hanoi-corrected.json"))
    assert done.returncode == 0, done.stderr
    assert done.stderr.splitlines()[-1] == "[]"


def test_what_signs_is_loaded_where_something_is_signed_alone(tmp_path: Path) -> None:
    """``check`` of a file with a record compares with the record, and does not load it. A picture
    says who has signed, so it is loaded if somebody has."""
    told = """
import sys
from smsl_studio.__main__ import main
status = main(sys.argv[1:])
print("cryptography" in sys.modules, file=sys.stderr)
sys.exit(status)
"""
    file = tmp_path / "door.json"
    shutil.copy(sample("hanoi-corrected.json"), file)
    make_key("Ada", "engineer", b"open", "ada")
    approve(ApprovalRequest(read(file), "ada", b"open"))
    other, picture = sample("hfsm.json"), str(tmp_path / "picture.svg")
    for words, loaded in (
        (("check", str(file)), "False"),
        (("run", str(file), "--world", "table"), "False"),
        (("run", other, "--world", "table", "--log", str(tmp_path / "run.jsonl")), "False"),
        (("digest", str(file)), "False"),
        (("render", other, "-o", picture), "False"),
        (("report", other, "-o", str(tmp_path / "report.html")), "False"),
        (("render", str(file), "-o", picture), "True"),
        (("verify", str(file)), "True"),
    ):
        done = python(told, *words)
        assert done.returncode == 0, done.stderr
        assert done.stderr.splitlines()[-1] == loaded, words


def test_a_window_does_not_load_what_signs_to_start() -> None:
    """Not with a blueprint that nobody has signed, and not with the start page."""
    told = """
import sys
from PySide6.QtWidgets import QApplication
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.style import prepare
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.shell.application import make_window
from smsl_studio.studio.shell.plugins import Plugins
from smsl_studio.studio.shell.windows import Windows
program = QApplication(["studio", "-platform", "offscreen"])
prepare(program, LIGHT)
windows = Windows(program, Settings(), Plugins(Loaded))
made = [make_window(windows, name) for name in ("", sys.argv[1])]
program.processEvents()
print("cryptography" in sys.modules, file=sys.stderr)
for window in made:
    window.close()
"""
    done = python(told, sample("hfsm.json"))
    assert done.returncode == 0, done.stderr
    assert done.stderr.splitlines()[-1] == "False"


@pytest.mark.parametrize(
    "arguments",
    [("check", sample("hfsm.json")), ("run", sample("hfsm.json"), "--world", "table")],
    ids=["check", "run"],
)
def test_a_command_loads_neither_qt_nor_physics(arguments: tuple[str, ...]) -> None:
    told = f"""
import sys
from smsl_studio.__main__ import main
status = main(sys.argv[1:])
print(sorted(set({HEAVY!r}) & set(sys.modules)), file=sys.stderr)
sys.exit(status)
"""
    done = python(told, *arguments)
    assert done.returncode == 0, done.stderr
    assert done.stderr.splitlines()[-1] == "[]"
