"""Quick makers of the events that every operation tells.

A frozen value sets each of its fields by a call. These makers set the fields before the value is
frozen, which takes a third of the time. What they make cannot be told from what the class makes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from typing import Any

from smsl_studio.runlog.event import Event
from smsl_studio.runlog.events import (
    Committed,
    FactChanged,
    Measured,
    OperationEnded,
    OperationStarted,
    StateChecked,
)


def maker(kind: type[Event]) -> Callable[..., Any]:
    """Return a function that makes an event of this class. Its parameters are all fields of the
    class, in their order.
    """
    draft = type(f"{kind.__name__}Draft", (kind,), {"__slots__": (), **_OPEN})
    names = [item.name for item in fields(kind)]
    lines = (f" made.{name} = {name}" for name in names)
    body = "\n".join((" made = draft()", *lines, " made.__class__ = kind", " return made"))
    known: dict[str, Any] = {"draft": draft, "kind": kind}
    exec(f"def make({', '.join(names)}):\n{body}", known)
    made: Callable[..., Any] = known["make"]
    return made


_OPEN = {
    "__init__": object.__init__,
    "__setattr__": object.__setattr__,
    "__delattr__": object.__delattr__,
}
"""What a draft has in place of the methods that freeze a value."""

fact_changed: Callable[[float, str, int, str | None, str], FactChanged] = maker(FactChanged)
operation_started: Callable[[float, str, str, str], OperationStarted] = maker(OperationStarted)
operation_ended: Callable[[float, str, str, str], OperationEnded] = maker(OperationEnded)
state_checked: Callable[[float, str, str, tuple[str, ...], tuple[str, ...]], StateChecked]
state_checked = maker(StateChecked)
committed: Callable[[float, tuple[str, ...], Mapping[str, str]], Committed] = maker(Committed)
measured: Callable[[float, str, int, str, str | None, str, float, str], Measured]
measured = maker(Measured)
