"""A long proof frees what it does not need any more, and no search for garbage in it is long."""

from __future__ import annotations

import gc
from collections.abc import Iterator

import pytest

from smsl_studio import stop
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.front.inputs import read
from smsl_studio.inspection.proof.exploration import Exploration
from smsl_studio.inspection.proof.space import Space
from smsl_studio.shipped import samples_dir


@pytest.fixture
def without_collection() -> Iterator[None]:
    """Nothing is freed but by its last reference."""
    enabled = gc.isenabled()
    gc.collect()
    gc.disable()
    yield
    if enabled:
        gc.enable()


@pytest.mark.parametrize("name", ["three-levels", "registration-digitization", "hfsm"])
def test_steps_that_are_made_anew_leave_no_memory_behind(
    name: str, monkeypatch: pytest.MonkeyPatch, without_collection: None
) -> None:
    monkeypatch.setattr("smsl_studio.inspection.proof.space._KEPT_STEPS", 3)
    before = _steppers()
    found = Exploration(Space(read(samples_dir() / f"{name}.json")), 1_000)
    assert len(found) > 3
    assert _steppers() - before == 1


def _steppers() -> int:
    return sum(isinstance(one, Stepper) for one in gc.get_objects())


@pytest.mark.parametrize(
    ("generation", "seconds", "spares"), [(2, 1.0, True), (2, 0.001, False), (1, 1.0, False)]
)
def test_what_a_long_collection_has_looked_at_is_not_looked_at_again(
    generation: int, seconds: float, spares: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    moments = iter((10.0, 10.0 + seconds))
    monkeypatch.setattr(stop, "monotonic", lambda: next(moments))
    before = gc.get_freeze_count()
    for phase in ("start", "stop"):
        stop.spare_the_old(phase, {"generation": generation})
    assert (gc.get_freeze_count() > before) is spares


def test_a_command_that_looks_for_garbage_spares_the_old(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gc, "callbacks", [])
    stop.let_garbage_be()
    try:
        stop.look_for_garbage()
        assert gc.isenabled()
        assert stop.spare_the_old in gc.callbacks
    finally:
        gc.enable()
