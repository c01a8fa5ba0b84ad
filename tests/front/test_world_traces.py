"""A run in a physical world has the same bytes in this process, in a child, in the window, and from
its log. ``benches/world_traces.py`` has sixty runs."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

from tests.front.test_traces import in_child_and_log, in_process, in_window
from tests.plugins.world_runs import WORLDS, world_run

SHORT = 2.5
"""Simulated seconds."""


@pytest.mark.parametrize("world", WORLDS)
def test_a_run_in_physics_leaves_the_same_trace_everywhere(
    world: str, tmp_path: Path, qapp: QApplication
) -> None:
    def wait(over: Callable[[], bool]) -> None:
        end = time.monotonic() + 60
        while not over():
            assert time.monotonic() < end, "the run does not end"
            qapp.processEvents()
            time.sleep(0.002)

    run = world_run(world, 1, SHORT)
    told = in_process(run)
    assert any('"operation_started"' in line for line in told)
    assert in_child_and_log(run, tmp_path / "log") == (told, told)
    assert in_window(run, wait) == told
