"""The wheel holds the data files, and works without a checkout."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from smsl_studio.shipped import docs_dir, plugins_dir, resources_dir, samples_dir

ROOT = Path(__file__).parents[2]
FOLDERS = ("docs", "plugins", "resources", "samples")


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that holds what the wheel holds, and nothing else."""
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True, timeout=120)
    (wheel,) = folder.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder / "site")
    return folder / "site"


def test_a_checkout_uses_its_own_folders() -> None:
    folders = [docs_dir(), plugins_dir(), resources_dir(), samples_dir()]
    assert folders == [ROOT / name for name in FOLDERS]


def test_the_wheel_holds_every_shipped_file_and_no_other(installed: Path) -> None:
    for name in FOLDERS:
        packed = installed / "smsl_studio" / "_shipped" / name
        here = {
            path.relative_to(ROOT / name)
            for path in (ROOT / name).rglob("*")
            if path.is_file() and "__pycache__" not in path.parts
        }
        assert {path.relative_to(packed) for path in packed.rglob("*") if path.is_file()} == here
    assert {path.name for path in installed.iterdir()} >= {"smsl_studio"}
    assert not (installed / "tests").exists()


@pytest.mark.parametrize("command", [["plugins"], ["check"], ["run", "--world", "table"]])
def test_the_wheel_works_alone(installed: Path, tmp_path: Path, command: list[str]) -> None:
    sample = str(installed / "smsl_studio/_shipped/samples/hfsm.json")
    files = [] if command == ["plugins"] else [sample]
    done = python(installed, tmp_path, "-m", "smsl_studio", command[0], *files, *command[1:])
    assert done.returncode == 0, done.stderr


def test_the_wheel_finds_its_own_plugins(installed: Path, tmp_path: Path) -> None:
    where = "from smsl_studio.shipped import plugins_dir; print(plugins_dir())"
    done = python(installed, tmp_path, "-c", where)
    assert Path(done.stdout.strip()) == installed / "smsl_studio/_shipped/plugins"


def python(site: Path, cwd: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run Python on what the wheel holds. Its modules are compiled once, beside it."""
    compiled = {"PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": str(site.parent / "compiled")}
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(site), **compiled},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
