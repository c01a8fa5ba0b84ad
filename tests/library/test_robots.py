"""Robots of worlds: named by a world, registered by a plugin, and asked for by name."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.errors import PluginError, UsageError
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.loading import discover
from smsl_studio.library.operation_library import OperationLibrary
from smsl_studio.world.arms.panda import ARM
from tests.plugin_folder import write_plugin

MORE = """
from dataclasses import replace
from smsl_studio.world.arms.panda import ARM

def register(library):
    library.robot(replace(ARM, name="long_panda", opening=0.039))
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = tmp_path_factory.mktemp("plugins")
    write_plugin(found, "more", MORE)
    return found


@pytest.mark.parametrize("look", [discover, describe])
def test_a_plugin_adds_a_robot_to_worlds_that_have_a_choice(look, folder: Path) -> None:  # type: ignore[no-untyped-def]
    loaded: Loaded = look([folder])
    assert loaded.robots("hanoi") == ("panda", "iiwa", "dvrk", "long_panda")
    assert loaded.robots("chess") == loaded.robots("table") == ()
    assert loaded.robot_name("hanoi", "panda") == loaded.robot_name("hanoi", "") == ""
    assert loaded.robot_name("hanoi", "iiwa") == "iiwa"
    assert any("more" in place for place in loaded.locations("hanoi"))


def test_the_value_is_that_of_the_plugin(folder: Path) -> None:
    loaded = discover([folder])
    own = loaded.robot("hanoi", "long_panda")
    assert own is not None
    assert own.opening == 0.039
    assert loaded.robot("hanoi", "") is ARM
    assert loaded.robot("chess", "") is None


@pytest.mark.parametrize(
    ("world", "asked", "words"),
    [
        ("hanoi", "pandas", "the world 'hanoi' has no robot 'pandas'"),
        ("chess", "panda", "the world 'chess' has no choice of robots"),
        ("table", "panda", "the world 'table' has no choice of robots"),
    ],
)
def test_an_unknown_robot_is_refused_with_the_names(world: str, asked: str, words: str) -> None:
    with pytest.raises(UsageError, match=words) as caught:
        discover().robot_name(world, asked)
    assert world != "hanoi" or "panda, iiwa, dvrk" in caught.value.advice


def test_only_a_robot_with_a_free_name_can_be_registered() -> None:
    library = OperationLibrary("some")
    with pytest.raises(PluginError, match="taken"):
        library.robot(ARM)
    with pytest.raises(PluginError, match="no Robot"):
        library.robot("panda")  # type: ignore[arg-type]
