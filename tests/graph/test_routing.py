"""The cheapest route has the same cost as in networkx, and ties are broken by one rule."""

from __future__ import annotations

from itertools import pairwise

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.errors import AddressError
from smsl_studio.graph.routing import Route, cheapest

Tables = dict[str, dict[str, str]]
STATES = ["A", "B", "C", "D", "E", "F"]
PRICES = [0.0, 0.1, 0.1, 0.2]


@st.composite
def branches(draw: st.DrawFn) -> tuple[StateBranch, dict[tuple[str, str], float]]:
    """A random multigraph with parallel edges, self loops, dangling targets and costs."""
    names = STATES[: draw(st.integers(2, 6))]
    edges = draw(
        st.dictionaries(
            st.tuples(st.sampled_from(names), st.sampled_from("pqrst")),
            st.tuples(st.sampled_from([*names, "Nowhere"]), st.sampled_from(PRICES)),
            max_size=16,
        )
    )
    table: Tables = {name: {} for name in names}
    for (source, operation), (target, _) in edges.items():
        table[source][operation] = target
    return StateBranch("SB", dict(table)), {edge: price for edge, (_, price) in edges.items()}


def routes_of(
    branch: StateBranch, prices: dict[tuple[str, str], float], avoid: set[Address]
) -> list[tuple[int, int, tuple[str, ...]]]:
    """Every simple route from A to B by brute force: cost in tenths, count, names."""
    found: list[tuple[int, int, tuple[str, ...]]] = []

    def go(state: str, seen: tuple[str, ...], names: tuple[str, ...], cost: int) -> None:
        if state == "B":
            found.append((cost, len(names), names))
            return
        for operation, target in branch.table[state].items():
            if target in branch.table and target not in seen:
                edge = Address("SB", state, operation)
                if (
                    edge not in avoid
                    and edge.parent not in avoid
                    and Address("SB", target) not in avoid
                ):
                    price = round(prices[state, operation] * 10)
                    go(target, (*seen, target), (*names, operation), cost + price)

    go("A", ("A",), (), 0)
    return found


@given(
    branches(),
    st.sets(st.tuples(st.sampled_from(STATES), st.sampled_from(["", *"pq"])), max_size=3),
)
def test_the_route_is_the_first_of_all_by_cost_count_and_names(
    drawn: tuple[StateBranch, dict[tuple[str, str], float]], left_out: set[tuple[str, str]]
) -> None:
    branch, prices = drawn
    avoid = {Address("SB", *edge) for edge in left_out}
    all_routes = routes_of(branch, prices, avoid)
    route = cheapest(branch, "A", "B", avoid=avoid, cost=lambda s, o: prices[s, o])
    if not all_routes:
        assert route is None
        return
    assert route is not None
    names = tuple(address.operation for address in route.operations)
    assert (round(route.cost * 10), len(names), names) == min(all_routes)
    for address, (state, target) in zip(route.operations, pairwise(route.states), strict=True):
        assert address.state == state
        assert branch.table[state][address.operation] == target


@given(branches())
def test_the_cost_is_the_one_networkx_finds(
    drawn: tuple[StateBranch, dict[tuple[str, str], float]],
) -> None:
    branch, prices = drawn
    oracle: nx.MultiDiGraph[str] = nx.MultiDiGraph()
    oracle.add_nodes_from(branch.table)
    for edge in branch.edges():
        if edge.target in branch.table:
            oracle.add_edge(edge.source, edge.target, weight=prices[edge.source, edge.name])
    lengths = nx.single_source_dijkstra_path_length(oracle, "A")
    for goal in branch.table:
        route = cheapest(branch, "A", goal, cost=lambda s, o: prices[s, o])
        assert (route is None) == (goal not in lengths)
        if route is not None:
            assert route.cost == pytest.approx(lengths[goal])


def test_decimal_costs_tie_exactly() -> None:
    branch = StateBranch("SB", {"A": {"y": "M", "x": "B"}, "M": {"y": "B"}, "B": {}})
    prices = {("A", "y"): 0.1, ("M", "y"): 0.2, ("A", "x"): 0.3}
    route = cheapest(branch, "A", "B", cost=lambda s, o: prices[s, o])
    assert route == Route((Address("SB", "A", "x"),), ("A", "B"), 0.3)


def test_equal_routes_are_told_apart_by_the_sequence_of_names() -> None:
    table: Tables = {
        "A": {"b": "M", "z": "B", "a": "N"},
        "M": {"a": "C"},
        "N": {"c": "C", "b": "C"},
        "C": {"z": "B", "y": "B"},
        "B": {},
    }
    prices = {("A", "z"): 3.0}

    def cost(state: str, operation: str) -> float:
        return prices.get((state, operation), 1.0)

    for reverse in (False, True):
        branch = StateBranch(
            "SB",
            {state: dict(sorted(ops.items(), reverse=reverse)) for state, ops in table.items()},
        )
        by_count = cheapest(branch, "A", "B", cost=cost)
        by_name = cheapest(branch, "A", "B", cost=cost, avoid=[Address("SB", "A", "z")])
        assert by_count is not None
        assert by_name is not None
        assert [a.operation for a in by_count.operations] == ["z"]
        assert [a.operation for a in by_name.operations] == ["a", "b", "y"]


def test_costs_come_from_the_annotations_of_the_branch() -> None:
    table: Tables = {"A": {"long": "M", "direct": "B"}, "M": {"go": "B"}, "B": {}}
    plain = cheapest(StateBranch("SB", dict(table)), "A", "B")
    fields = {"_operations": {"A/direct": {"cost": 5}}}
    priced = cheapest(StateBranch("SB", dict(table), fields=fields), "A", "B")
    assert plain is not None
    assert priced is not None
    assert [a.operation for a in plain.operations] == ["direct"]
    assert [a.operation for a in priced.operations] == ["long", "go"]
    assert priced.cost == 2.0


def test_a_goal_that_holds_needs_no_operation() -> None:
    branch = StateBranch("SB", {"A": {"loop": "A"}})
    assert cheapest(branch, "A", "A") == Route((), ("A",), 0.0)


def test_infinite_costs_take_an_operation_out() -> None:
    branch = StateBranch("SB", {"A": {"x": "B"}, "B": {}})
    assert cheapest(branch, "A", "B", cost=lambda s, o: float("inf")) is None


@pytest.mark.parametrize("price", [-1.0, float("nan")])
def test_a_cost_that_is_no_cost_is_told(price: float) -> None:
    branch = StateBranch("SB", {"A": {"x": "B"}, "B": {}})
    with pytest.raises(ValueError, match="SB/A/x"):
        cheapest(branch, "A", "B", cost=lambda s, o: price)


def test_an_unknown_state_is_told_with_a_near_name() -> None:
    with pytest.raises(AddressError) as error:
        cheapest(StateBranch("SB", {"State_a": {}}), "State_a", "State_b")
    assert error.value.advice == "Did you mean State_a?"
