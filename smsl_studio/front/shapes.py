"""Changes the shape of a blueprint without changing its behaviour, and compares behaviours."""

from __future__ import annotations

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.generate.flat import flat_values
from smsl_studio.inspection.equivalence.equivalence import Equivalence, equivalence
from smsl_studio.inspection.explorer.part import restricted
from smsl_studio.smsl.json_form import parse_json, write_json

LIMIT = 1_000_000
"""The largest number of configurations that are stored."""


def diff_behaviour(before: Blueprint, after: Blueprint, limit: int = LIMIT) -> Equivalence:
    """Compare what two blueprints do: bisimulation over configurations from their starts.

    Facts, INITIAL and permitted operations count. ``path`` is a shortest run after which the two
    differ. At most ``limit`` configurations of each are stored; ``equal`` is None beyond that.
    RunRefused if one of them has no start.

    >>> found = diff_behaviour(read("hanoi.json"), read("hanoi-corrected.json"))
    >>> found.equal, len(found.path)
    (False, 6)
    """
    return equivalence(before, after, limit)


def flatten(blueprint: Blueprint, branch: str | None = None, limit: int = LIMIT) -> Blueprint:
    """Return a blueprint with one SB that behaves as the whole (paper, hFSM).

    Its states are the configurations that can be reached, its operations the steps between them.
    With ``branch`` that SB and all below it become one SB, and the others are left out.
    PlanningError if there are more than ``limit`` configurations, RunRefused if there is no start.
    EditRefused if an operation requires a fact of an SB that is left out.

    >>> flat = flatten(read("hfsm.json"))
    >>> len(flat["SB1"].table), diff_behaviour(read("hfsm.json"), flat).equal
    (4, True)
    """
    part = blueprint if branch is None else _below(blueprint, branch)
    text = write_json(flat_values(part, limit))
    return read_blueprint(parse_json(text, blueprint.file))


def _below(blueprint: Blueprint, branch: str) -> Blueprint:
    """Return an SB with all below it as a blueprint."""
    hierarchy = Hierarchy(blueprint)
    names = hierarchy.tree(blueprint[branch].name)
    edges = Edges(hierarchy)
    for name in names:
        outside = sorted(edges.required_by(name) - set(names))
        if outside:
            raise EditRefused(
                f"{branch} was not flattened alone: operations of {name} require facts of "
                f"{outside[0]}, which would be left out",
                advice="Flatten the whole file.",
            )
    return restricted(blueprint, [name for name in blueprint.branches if name in names])
