"""What a person has chosen about automatic supervisors for the next run."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class SupervisorChoice:
    """Automatic supervisors as they are asked for (``NAME:key=value``), and a level of
    forecasts."""

    agents: tuple[str, ...] = ()
    forecast: str = ""


NOBODY = SupervisorChoice()
