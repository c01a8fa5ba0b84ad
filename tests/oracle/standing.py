"""The joint states that are possible: clauses 1, 3 and the goals of clause 11.

Everything is found by trying, because the blueprints of these tests are small.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from tests.oracle.drawing import Drawing

Configuration = dict[str, str]


def bases_first(drawing: Drawing) -> list[str]:
    """The names of all SBs, each behind every SB that it expands a fact of."""
    ordered: list[str] = []
    while len(ordered) < len(drawing.branches):
        for name, bases in drawing.bases.items():
            if name not in ordered and all(base in ordered for base, _ in bases):
                ordered.append(name)
    return ordered


def split_digits(drawing: Drawing, configuration: Mapping[str, str]) -> list[str]:
    """The facts for which the invariant of clause 1 does not hold: on, but the sub is not in
    ACTIVATING, or the reverse."""
    return [
        f"{branch.name}/{digit}"
        for branch in drawing.branches.values()
        for digit, sub in branch.subs.items()
        if branch.is_on(configuration[branch.name], digit)
        != (configuration[sub] == drawing.branches[sub].activating)
    ]


def all_configurations(drawing: Drawing) -> list[Configuration]:
    """Every configuration for which clause 1 holds."""
    found: list[Configuration] = [{}]
    for name in bases_first(drawing):
        found = [{**one, name: state} for one in found for state in _states(drawing, one, name)]
    return found


def _states(drawing: Drawing, above: Mapping[str, str], name: str) -> Iterator[str]:
    """The states of an SB that the states of its bases allow."""
    branch = drawing.branches[name]
    said = {drawing.branches[base].is_on(above[base], digit) for base, digit in drawing.bases[name]}
    for state in branch.states:
        if all(on == (state == branch.activating) for on in said):
            yield state


def start_of(drawing: Drawing, given: Mapping[str, str]) -> Configuration | str:
    """Clause 3: where a run starts, or why it must be refused."""
    found: Configuration = {}
    for name in bases_first(drawing):
        branch = drawing.branches[name]
        bases = drawing.bases[name]
        if bases and branch.initial == branch.activating:
            return f"INITIAL of the sub-SB {name} is its ACTIVATING (clause 1)"
        said = {drawing.branches[base].is_on(found[base], digit) for base, digit in bases}
        if len(said) > 1:
            return f"the bases of {name} do not agree"
        state = given.get(name, branch.initial)
        if said:
            (on,) = said
            if name not in given:
                state = branch.activating if on else branch.initial
            elif on != (state == branch.activating):
                return f"{name}/{state} does not agree with its base"
        found[name] = state
    return found


def goals_of(drawing: Drawing, given: list[str]) -> list[str]:
    """Clause 11: the goals of a run, bases first, else in file order."""
    if not given:
        return [f"{name}/{drawing.branches[name].activating}" for name in drawing.roots]
    names = list(drawing.branches)

    def depth(name: str) -> int:
        return max((1 + depth(base) for base, _ in drawing.bases[name]), default=0)

    return sorted(given, key=lambda goal: (depth(_name(goal)), names.index(_name(goal))))


def contradict(drawing: Drawing, goals: list[str]) -> bool:
    """Whether goals, each of which some configuration has, are in no configuration together."""
    every = all_configurations(drawing)

    def hold(some: list[str]) -> bool:
        wanted = [(_name(goal), goal.split("/", 1)[1]) for goal in some]
        return any(all(one[name] == state for name, state in wanted) for one in every)

    return all(hold([goal]) for goal in goals) and not hold(goals)


def _name(goal: str) -> str:
    return goal.split("/", 1)[0]
