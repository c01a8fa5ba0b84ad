"""The bench of stops names functions of the program: a renamed one would measure nothing."""

from __future__ import annotations

from importlib import import_module

import pytest

from benches.stops.scenes import SCENES


@pytest.mark.parametrize("phase", SCENES)
def test_each_phase_names_functions_that_exist(phase: str) -> None:
    scene = SCENES[phase]
    for name in filter(None, (scene.forks, scene.reached)):
        module, _, path = name.partition(":")
        found = import_module(module)
        for part in path.split("."):
            found = getattr(found, part)
        assert callable(found), name
