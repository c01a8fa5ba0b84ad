"""Changes the shape of a blueprint without changing its behaviour, and compares behaviours."""

from __future__ import annotations

from collections.abc import Collection

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.front.inputs import must_be_whole
from smsl_studio.generate.flat import FlatBranch
from smsl_studio.generate.shapes.extract import cut_out
from smsl_studio.generate.shapes.identify import Identification, identification
from smsl_studio.generate.shapes.inline import put_back
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
    for one in (before, after):
        must_be_whole(one)
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
    must_be_whole(blueprint)
    part = blueprint if branch is None else _below(blueprint, branch)
    text = write_json(FlatBranch(part, limit).values())
    return read_blueprint(parse_json(text, blueprint.file))


def extract(
    blueprint: Blueprint, branch: str, states: Collection[str], name: str, limit: int = LIMIT
) -> Blueprint:
    """Return a blueprint in which some states of an SB are a sub-SB ``name`` of it.

    The base has one state for them. The sub-SB has them, with the facts in which they differ or
    that change when they are left, and one more state, ACTIVATING. CutRefused (an EditRefused),
    with a run that shows why, if the result would not behave as before. PlanningError if there are
    more than ``limit`` configurations, RunRefused if there is no start.

    >>> flat = flatten(read("registration-digitization.json"))
    >>> cut = extract(flat, "REGISTRATION", ["State100+State0"], "DIGITIZATION")
    >>> list(cut["DIGITIZATION"].table)
    ['State100+State0', 'State_done']
    """
    must_be_whole(blueprint)
    return cut_out(blueprint, branch, states, name, limit)[0]


def inline(blueprint: Blueprint, sub: str, limit: int = LIMIT) -> Blueprint:
    """Return a blueprint in which a sub-SB and its base are one SB that behaves alike.

    EditRefused if it has not exactly one base, if operations of the two require facts of other
    SBs, or if a property names one of their states. PlanningError if there are more than ``limit``
    configurations, RunRefused if there is no start.

    >>> whole = inline(read("hfsm.json"), "SB2")
    >>> list(whole.branches), diff_behaviour(read("hfsm.json"), whole).equal
    (['SB1'], True)
    """
    must_be_whole(blueprint)
    return put_back(blueprint, sub, limit)


def identify(blueprint: Blueprint, limit: int = LIMIT) -> Identification:
    """Return the states that could be a sub-SB, what each cut saves, and why; the best first.

    Only cuts after which the blueprint behaves as before are listed, at most 100 (paper, "SB
    identification"). PlanningError if there are more than ``limit`` configurations, RunRefused if
    there is no start.

    >>> found = identify(flatten(read("registration-digitization.json")))
    >>> found.cuts[0].why[:70]
    '1 state is entered at State100+State0 and left through REGISTRATION.La'
    >>> identify(read("hanoi-corrected.json")).cuts
    ()
    """
    must_be_whole(blueprint)
    return identification(blueprint, limit)


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
