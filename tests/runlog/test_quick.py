"""Quickly made events cannot be told from those that their classes make."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from dataclasses import FrozenInstanceError, fields, replace
from typing import Any

import pytest

from smsl_studio.runlog import quick
from smsl_studio.runlog.event import Event
from smsl_studio.runlog.events import (
    Committed,
    FactChanged,
    OperationEnded,
    OperationStarted,
    StateChecked,
)

MADE: tuple[tuple[Callable[..., Any], Event], ...] = (
    (quick.fact_changed, FactChanged(t=0.1, branch="S", digit=2, value=None, reason="late")),
    (quick.operation_started, OperationStarted(t=0.1, address="S/A/o", target="B", function="f")),
    (quick.operation_ended, OperationEnded(t=0.2, address="S/A/o", outcome="failed", message="m")),
    (quick.state_checked, StateChecked(t=0.3, address="S/B", result="false", misses=("Fact 1",))),
    (quick.committed, Committed(t=0.4, operations=("S/A/o",), configuration={"S": "B"})),
)


@pytest.mark.parametrize(("make", "event"), MADE, ids=[one.event for _, one in MADE])
def test_it_is_the_same_event(make: Callable[..., Any], event: Event) -> None:
    values = [getattr(event, item.name) for item in fields(event)]
    made = make(*values)
    assert type(made) is type(event)
    assert made == event
    assert repr(made) == repr(event)
    assert made.line() == event.line()
    assert replace(made, t=9.0) == replace(event, t=9.0)
    assert pickle.loads(pickle.dumps(made)) == event
    frozen: Any = made
    with pytest.raises(FrozenInstanceError):
        frozen.t = 1.0
    with pytest.raises(FrozenInstanceError):
        del frozen.t
