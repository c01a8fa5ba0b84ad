"""Shape and hierarchy, compared with networkx."""

from __future__ import annotations

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.elements import Header
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.hierarchy import cycles, levels
from smsl_studio.graph.shape import (
    can_reach,
    components,
    dead_ends,
    islands,
    reachable,
    traps,
)
from smsl_studio.smsl.json_form import parse_json

Tables = dict[str, dict[str, str]]
NAMES = [f"S{i}" for i in range(9)]


@st.composite
def branches(draw: st.DrawFn) -> StateBranch:
    edge = st.tuples(st.sampled_from(NAMES), st.sampled_from("pqrs"))
    targets = st.sampled_from([*NAMES, "Nowhere"])
    edges = draw(st.dictionaries(edge, targets, max_size=20))
    table: dict[str, dict[str, str]] = {name: {} for name in NAMES}
    for (source, operation), target in edges.items():
        table[source][operation] = target
    return StateBranch("SB", dict(table))


def oracle_of(branch: StateBranch) -> nx.MultiDiGraph[str]:
    oracle: nx.MultiDiGraph[str] = nx.MultiDiGraph()
    oracle.add_nodes_from(branch.table)
    oracle.add_edges_from((e.source, e.target) for e in branch.edges() if e.target in branch.table)
    return oracle


@given(branches())
def test_reachability_is_the_one_of_networkx(branch: StateBranch) -> None:
    oracle = oracle_of(branch)
    for name in NAMES[:3]:
        assert reachable(branch, name) == nx.descendants(oracle, name) | {name}
        assert can_reach(branch, name) == nx.ancestors(oracle, name) | {name}


@given(branches())
def test_components_are_those_of_networkx(branch: StateBranch) -> None:
    oracle = oracle_of(branch)
    strong = {frozenset(group) for group in components(branch)}
    assert strong == set(map(frozenset, nx.strongly_connected_components(oracle)))
    weak = {frozenset(group) for group in islands(branch)}
    assert weak == set(map(frozenset, nx.weakly_connected_components(oracle)))


def test_a_long_chain_does_not_exhaust_the_stack() -> None:
    size = 5000
    table = {f"S{i}": {"go": f"S{(i + 1) % size}"} for i in range(size)}
    assert len(components(StateBranch("SB", dict(table)))) == 1


def test_dead_ends_and_traps() -> None:
    table: Tables = {
        "A": {"x": "B", "y": "C"},
        "B": {"x": "Goal"},
        "C": {"x": "C"},
        "Goal": {},
        "Lost": {},
    }
    branch = StateBranch("SB", dict(table))
    assert dead_ends(branch) == ("Goal", "Lost")
    assert traps(branch, "A", "Goal") == ("C",)


def test_the_graph_is_built_once_a_branch() -> None:
    branch = StateBranch("SB", {"A": {"x": "A", "lost": "Nowhere"}})
    assert graph_of(branch) is graph_of(branch)
    assert list(graph_of(branch).operations) == ["x"]


def hierarchy(**subs: str) -> Blueprint:
    """SBs by name, each with its sub-SBs as a word of one-letter names."""
    branches = {
        name: StateBranch(
            name,
            {"State_0": {}},
            Header(sub_sbs=tuple((sub, digit) for digit, sub in enumerate(below))),
        )
        for name, below in subs.items()
    }
    return Blueprint(branches, parse_json("{}", "test.json"))


def test_levels_are_the_longest_way_down() -> None:
    assert levels(hierarchy(A="BC", B="C", C="", D="")) == {"A": 0, "B": 1, "C": 2, "D": 0}
    assert cycles(hierarchy(A="BC", B="C", C="", D="")) == ()


def test_cycles_are_told_once_and_do_not_stop_the_levels() -> None:
    looped = hierarchy(C="B", A="B", B="C", D="D", E="Z")
    assert cycles(looped) == (("C", "B"), ("D",))
    assert levels(looped) == {"C": 2, "A": 0, "B": 1, "D": 0, "E": 0}
