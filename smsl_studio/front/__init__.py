"""The front door: every room wired once, by plain constructors.

Each name is loaded when it is first asked for, so that ``import smsl_studio`` costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from smsl_studio.front.hosting import worlds
    from smsl_studio.front.reading import inspect, read, refusals
    from smsl_studio.front.routes import plan_route
    from smsl_studio.front.running import Run, open_run, run
    from smsl_studio.front.script.reading import read_script
    from smsl_studio.front.suiting import worlds_for
    from smsl_studio.front.sweeping import sweep
    from smsl_studio.front.trying import try_edge

__all__ = [
    "Run",
    "inspect",
    "open_run",
    "plan_route",
    "read",
    "read_script",
    "refusals",
    "run",
    "sweep",
    "try_edge",
    "worlds",
    "worlds_for",
]

_HOMES = {
    "read": "reading",
    "read_script": "script.reading",
    "inspect": "reading",
    "refusals": "reading",
    "plan_route": "routes",
    "Run": "running",
    "run": "running",
    "open_run": "running",
    "worlds": "hosting",
    "worlds_for": "suiting",
    "sweep": "sweeping",
    "try_edge": "trying",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
