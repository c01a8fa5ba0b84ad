"""A forecast of one operation as supervisors see it: what the simulated world says will happen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.runlog.regulation import AGREES, DIFFERS, NONE

__all__ = ["AGREES", "DIFFERS", "NONE", "Prediction"]


@dataclass(frozen=True, slots=True)
class Prediction:
    """What the simulated world predicts for an operation, compared with what the blueprint says.

    ``verdict`` is ``agrees``, ``differs``, or ``none`` without a forecast. ``after`` has each
    sensed fact (None: unknown) by ``SB/digit``; it is empty without a forecast. ``reason`` says in
    words what differs, or why there is no forecast. ``by_people`` says that there is none because
    a person carries it out or has to answer. Such an operation needs none. ``apart`` are the facts
    that will differ from what the blueprint declares.
    """

    verdict: str
    after: Mapping[str, str | None] = field(default_factory=dict)
    reason: str = ""
    by_people: bool = False
    apart: tuple[str, ...] = ()
