"""SMSL Studio: draw, inspect and run blueprints of medical and robotic procedures.

::

    import smsl_studio as smsl

    blueprint = smsl.read("samples/hanoi.json")
    for finding in smsl.inspect(blueprint):
        print(finding)
    route = smsl.plan_route(blueprint["SB1"], "State_aaa", "State_ccc")
    run = smsl.run(blueprint, world="table", goal="State_ccc")

Importing the package loads no Qt, PyBullet, pyqtgraph, scipy or networkx.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from smsl_studio.front import __all__ as __all__

if TYPE_CHECKING:
    from smsl_studio.front import *  # noqa: F403


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from smsl_studio import front

    return getattr(front, name)


def __dir__() -> list[str]:
    return sorted(__all__)
