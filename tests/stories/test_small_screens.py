"""A small screen with large letters: Stop is fully visible and can be pressed, in each mode."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.shipped import samples_dir

STOP = [136, 40]
"""Pixels that Stop has everywhere."""


def sit_at(
    width: int, height: int, scale: str, folder: Path, program: str = "small_screen"
) -> dict[str, Any]:
    """Run through the modes on a screen of so many pixels; what was where."""
    screen = {"name": "A", "x": 0, "y": 0, "width": width, "height": height, "logicalDpi": 96,
              "logicalBaseDpi": 96, "dpr": 1}  # fmt: skip
    described = folder / "screen.json"
    described.write_text(json.dumps({"screens": [screen]}))
    done = subprocess.run(
        [sys.executable, "-m", f"tests.stories.{program}", str(samples_dir() / "hanoi-2.json")],
        check=False,
        capture_output=True,
        text=True,
        timeout=120,
        cwd=Path(__file__).parents[2],
        env={
            **os.environ,
            "QT_QPA_PLATFORM": f"offscreen:configfile={described}",
            "QT_SCALE_FACTOR": scale,
            "SMSL_STUDIO_HOME": str(folder),
        },
    )
    assert done.returncode == 0, done.stderr[-2000:]
    told: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return told


def inside(box: list[int], other: list[int]) -> bool:
    return all(
        other[at] <= box[at] and box[at] + box[at + 2] <= other[at] + other[at + 2] for at in (0, 1)
    )


@pytest.mark.parametrize("scale", ["1", "2"])
def test_stop_is_whole_in_every_mode_on_a_screen_of_1280_by_720(scale: str, tmp_path: Path) -> None:
    told = sit_at(1280, 720, scale, tmp_path)
    low = scale == "2"
    assert told["canvas"][3] > (200 if low else 250), "the drawing has the room"
    assert (told["findings by key"][3] > 40) is low, "in a low window they wait for the key"
    for mode in ("draw", "run", "supervise"):
        assert inside(told[f"frame in {mode}"], told["screen"]), (mode, told)
        assert inside(told[mode], told["screen"]), (mode, told)
        assert told[mode][2:] == STOP, (mode, told)
    seen = {name: where for name, where in told.items() if name.startswith("seen: ")}
    assert {"seen: The run: Stopped", "seen: Reset", "seen: Prune", "seen: Take over"} <= set(seen)
    for name, where in seen.items():
        assert inside(where, told["screen"]), (name, where, told)


@pytest.mark.parametrize("scale", ["1", "2"])
def test_every_dialog_is_whole_on_a_screen_of_1280_by_720(scale: str, tmp_path: Path) -> None:
    told = sit_at(1280, 720, scale, tmp_path, "small_dialogs")
    screen = told.pop("screen")
    assert len(told) == 16
    for name, dialog in told.items():
        assert inside(dialog["frame"], screen), (name, dialog, screen)
        assert dialog["cut"] == [], name
        for words, button in dialog["buttons"].items():
            assert inside(button, dialog["frame"]), (name, words, button, dialog)
