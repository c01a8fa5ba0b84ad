"""Modules import only from lower layers, and each third-party library is used in one place."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.house.imports import FLOORS, PACKAGE, faults, imports_of, room_of
from tests.house.survey import survey

ROOT = Path(__file__).parents[2]


def test_imports_look_down_and_libraries_stay_at_home() -> None:
    assert faults(ROOT / PACKAGE) == []


def test_every_room_stands_in_the_table() -> None:
    rooms = {room_of(item.file) for item in imports_of(ROOT / PACKAGE)}
    assert rooms <= set(FLOORS)


def test_plugins_know_neither_the_engine_nor_the_window() -> None:
    foreign = {"PySide6", "shiboken6", "pyqtgraph", "moderngl", "pybullet", "pybullet_data"}
    doors = {f"{PACKAGE}.{door}" for door in ("studio", "cli")}
    for item in imports_of(ROOT / "plugins"):
        assert item.name.partition(".")[0] not in foreign, item
        assert not any(item.name.startswith(door) for door in doors), item


@pytest.mark.parametrize(
    ("file", "source", "words"),
    [
        ("graph/a.py", "from smsl_studio.front import run", "upstairs"),
        ("graph/a.py", "def f():\n    import smsl_studio.dispatch.dispatcher", "upstairs"),
        ("graph/a.py", "from smsl_studio.world.protocol import World", "neighbour"),
        ("graph/a.py", "from smsl_studio import cli", "upstairs"),
        ("graph/a.py", "import smsl_studio as smsl", "upstairs"),
        ("graph/a.py", "from .. import blueprint", "relative"),
        ("cli/a.py", "from smsl_studio.studio.shell import application", "neighbour"),
        (
            "cli/a.py",
            "import importlib as i\ni.import_module('smsl_studio.studio')",
            "neighbour",
        ),
        ("cli/a.py", "from PySide6.QtCore import Qt", "lives in studio/"),
        ("world/table.py", "def f():\n    import pybullet", "lives in world/bullet.py"),
        ("inspection/a.py", "from scipy.sparse import csgraph", "lives in graph/"),
        ("front.py", "__import__('networkx')", "lives in graph/exchange.py"),
        ("front.py", "import requests", "no home"),
        ("utils.py", "import smsl_studio.errors", "no room"),
        ("studio/a.py", "from smsl_studio.studio.base.theme import LIGHT", "no floor"),
        ("studio/base/a.py", "from smsl_studio.studio.document.session import S", "upstairs"),
        ("studio/document/a.py", "from smsl_studio.studio import running", "upstairs"),
        ("studio/running/a.py", "def f():\n    import smsl_studio.studio.features.run", "upstairs"),
        ("studio/features/run/a.py", "from smsl_studio.studio.shell.window import W", "upstairs"),
        ("studio/features/run/a.py", "from smsl_studio.studio.features.draw import x", "neighbour"),
        ("studio/features/run/a.py", "from smsl_studio.studio.features import draw", "neighbour"),
        ("studio/shell/a.py", "from smsl_studio.studio.features.run.pane import R", "names a"),
    ],
)
def test_a_planted_violation_is_seen(tmp_path: Path, file: str, source: str, words: str) -> None:
    path = tmp_path / file
    path.parent.mkdir(exist_ok=True, parents=True)
    path.write_text(source, "utf-8")
    (fault,) = faults(tmp_path)
    assert words in fault
    assert fault.startswith(f"{file}:{len(source.splitlines())}:")


@pytest.mark.parametrize(
    ("file", "source"),
    [
        ("graph/a.py", "import numpy, scipy, json\nfrom smsl_studio.blueprint.model import State"),
        ("graph/a.py", "from smsl_studio.graph.build import graph_of"),
        ("front.py", "from smsl_studio import errors, dispatch"),
        ("cli/a.py", "import smsl_studio as smsl\nfrom smsl_studio.front import read"),
        ("world/bullet.py", "import pybullet, pybullet_utils"),
        ("world/models.py", "import pybullet_data"),
        ("studio/a.py", "from PySide6.QtCore import Qt"),
        ("studio/shell/features.py", "from smsl_studio.studio.features.run.pane import RunPane"),
        ("studio/shell/a.py", "from smsl_studio.studio.shell.features import Features"),
        ("studio/features/run/a.py", "from smsl_studio.studio.features.run.pane import RunPane"),
        ("studio/features/run/a.py", "from smsl_studio.studio.running.timeline import Timeline"),
        ("studio/document/a.py", "from smsl_studio.studio.base import words"),
        ("__init__.py", "from smsl_studio.front import read"),
        ("__main__.py", "from smsl_studio.studio.shell.application import main"),
    ],
)
def test_what_the_rule_allows_is_left_alone(tmp_path: Path, file: str, source: str) -> None:
    path = tmp_path / file
    path.parent.mkdir(exist_ok=True, parents=True)
    path.write_text(source, "utf-8")
    assert faults(tmp_path) == []


def test_the_checker_reads_the_whole_house() -> None:
    assert sum(bool(one.asked) for one in survey(ROOT / PACKAGE)) > 20
