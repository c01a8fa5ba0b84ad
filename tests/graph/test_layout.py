"""The layouts: their expected look, and that no node ever covers another."""

from __future__ import annotations

import itertools
from pathlib import Path
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.elements import Header
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate import rules
from smsl_studio.graph import taken_places
from smsl_studio.graph.arrangement import KINDS, LAYERS, ties_for
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.crossings import is_clear
from smsl_studio.graph.layout import (
    MOST_SPREAD,
    QUICK,
    TENTH,
    is_grid,
    is_placed,
    place_anew,
    place_states,
)
from smsl_studio.graph.shape import distances
from smsl_studio.graph.triangle import in_triangle
from smsl_studio.smsl.json_form import parse_json
from tests.bombs.test_work import steps
from tests.counts import share_of

SAMPLES = Path(__file__).parents[2] / "samples"
Tables = dict[str, dict[str, str]]
Places = dict[str, tuple[float, float]]


def sample(name: str) -> Blueprint:
    path = SAMPLES / name
    return read_blueprint(parse_json(path.read_text("utf-8"), name))


def hanoi(disks: int, pegs: str = "abc") -> dict[str, dict[str, str]]:
    table: Tables = {}
    for state in itertools.product(pegs, repeat=disks):
        moves = table.setdefault("State_" + "".join(state), {})
        for disk, peg in itertools.product(range(disks), pegs):
            if peg != state[disk] and not {state[disk], peg} & set(state[:disk]):
                target = [*state[:disk], peg, *state[disk + 1 :]]
                moves[f"Op_{disk + 1}{peg}"] = "State_" + "".join(target)
    return table


def chain(*names: str, more: dict[str, dict[str, str]] | None = None) -> StateBranch:
    table: Tables = {name: {} for name in names}
    for a, b in itertools.pairwise(names):
        table[a]["go"] = b
    for name, operations in (more or {}).items():
        table[name] |= operations
    return StateBranch("SB", dict(table))


def covers(places: Places, width: float = 130.0, height: float = 70.0) -> list[tuple[str, str]]:
    """Pairs of nodes nearer than this in both directions, found cell by cell."""
    cells: dict[tuple[int, int], list[str]] = {}
    found: list[tuple[str, str]] = []
    for name, (x, y) in places.items():
        i, j = int(x // width), int(y // height)
        for near in itertools.product((i - 1, i, i + 1), (j - 1, j, j + 1)):
            for other in cells.get(near, ()):
                if abs(places[other][0] - x) < width and abs(places[other][1] - y) < height:
                    found.append((other, name))
        cells.setdefault((i, j), []).append(name)
    return found


def rows(places: Places) -> dict[float, list[str]]:
    found: dict[float, list[str]] = {}
    for name in sorted(places, key=lambda n: places[n]):
        found.setdefault(places[name][1], []).append(name)
    return found


def test_hanoi_is_the_symmetric_triangle() -> None:
    places = place_states(sample("hanoi.json")["SB1"])
    lines = [[n.removeprefix("State_") for n in row] for _, row in sorted(rows(places).items())]
    assert lines == [
        ["aaa"],
        ["baa", "caa"],
        ["bca", "cba"],
        ["cca", "aca", "aba", "bba"],
        ["ccb", "bbc"],
        ["acb", "bcb", "cbc", "abc"],
        ["abb", "bab", "cac", "acc"],
        ["bbb", "cbb", "cab", "aab", "aac", "bac", "bcc", "ccc"],
    ]
    assert places["State_aaa"] == (0.0, 0.0)
    mirrored = str.maketrans("bc", "cb")
    for name, (x, y) in places.items():
        assert places["State_" + name.removeprefix("State_").translate(mirrored)] == (-x, y)


def test_the_triangle_does_not_know_names() -> None:
    table = hanoi(2)
    new = {name: f"N{i}" for i, name in enumerate(reversed(table))}
    renamed = {
        new[name]: {f"o{i}": new[target] for i, target in enumerate(operations.values())}
        for name, operations in table.items()
    }
    before, after = (
        place_states(StateBranch("X", dict(table))),
        place_states(StateBranch("X", dict(renamed))),
    )
    assert before == {name: after[new[name]] for name in table}
    assert len(rows(before)) == 4


def test_the_triangle_stands_on_its_side_for_no_header() -> None:
    table = hanoi(4)
    header = Header(initial="State_bbbb", activating="State_aaaa")
    places = place_states(StateBranch("SB", dict(table), header))
    assert min(places, key=lambda name: places[name][1]) == "State_bbbb"
    assert max(places, key=lambda name: places[name]) == "State_aaaa"
    assert len(rows(places)) == 16
    assert not covers(places)


@pytest.mark.parametrize("initial", ["State_abc", "State_cab", "State_bba", "State_aab"])
def test_the_apex_is_the_corner_nearest_to_initial(initial: str) -> None:
    places = place_states(StateBranch("SB", dict(hanoi(3)), Header(initial=initial)))
    assert [len(row) for _, row in sorted(rows(places).items())] == [1, 2, 2, 4, 2, 4, 4, 8]
    top = min(places, key=lambda name: places[name][1])
    assert top in {"State_aaa", "State_bbb", "State_ccc"}


def test_a_slip_of_the_hand_does_not_spoil_the_triangle() -> None:
    table = hanoi(3)
    good = place_states(StateBranch("SB", dict(table)))
    deleted = {**table, "State_aba": {"Op_1a": "State_bba"}}
    astray = {**table, "State_cbb": {**table["State_cbb"], "Op_1a": "State_caa"}}
    for slipped in (deleted, astray):
        assert place_states(StateBranch("SB", dict(slipped))) == good


def test_registration_is_a_grid_of_four_columns_and_two_rows() -> None:
    places = place_states(sample("registration.json")["REGISTRATION"])
    assert rows(places) == {
        0.0: ["State_0000", "State_1000", "State_1100", "State_1101"],
        172.0: ["State_0010", "State_1010", "State_1110", "State_1111"],
    }
    columns = sorted({x for x, _ in places.values()})
    assert len(columns) == 4
    assert all(218 <= b - a <= 260 for a, b in itertools.pairwise(columns))


def test_hfsm_leaves_its_line_free() -> None:
    places = place_states(sample("hfsm.json")["SB1"])
    assert sorted(places, key=lambda n: places[n]) == list(places)
    assert len({places[f"State{n}"][1] for n in ("000", "100", "111")}) == 1
    assert places["State110"][1] < places["State100"][1] - 54


def test_a_chain_is_a_line_and_a_sub_sb_two_nodes_side_by_side() -> None:
    places = place_states(chain("First", "Second", "Third", "Fourth"))
    assert [places[n] for n in places] == [(218.0 * i, 0.0) for i in range(4)]
    sub = place_states(sample("hfsm.json")["SB2"])
    assert sub == {"State0": (0.0, 0.0), "State1": (218.0, 0.0)}


def test_a_ring_bows_around_the_way_back() -> None:
    names = ["One", "Two", "Three", "Four", "Five"]
    branch = chain(*names, more={"Five": {"back": "One"}})
    places = place_states(branch)
    assert sorted(places, key=lambda name: places[name]) == names
    assert places["One"][1] == places["Five"][1]
    assert all(places[name][1] <= places["One"][1] - 54 for name in names[1:4])
    assert is_clear(ties_for(branch), np.array([places[name] for name in names]))


def test_a_star_has_its_leaves_in_one_column() -> None:
    leaves = {f"leaf{i}": f"Leaf {i}" for i in range(8)}
    branch = StateBranch("SB", {"Hub": leaves, **{leaf: {} for leaf in leaves.values()}})
    places = place_states(branch)
    assert len({places[leaf][0] for leaf in leaves.values()}) == 1
    assert min(places, key=lambda name: places[name]) == "Hub"
    heights = sorted(places[leaf][1] for leaf in leaves.values())
    assert {b - a for a, b in itertools.pairwise(heights)} == {110.0}
    assert not covers(places)
    at = np.array([places[name] for name in branch.table])
    assert is_clear(ties_for(branch), at)


def cube(bits: int) -> StateBranch:
    table = {
        f"State{i:0{bits}b}": {f"o{bit}": f"State{i ^ (1 << bit):0{bits}b}" for bit in range(bits)}
        for i in range(1 << bits)
    }
    return StateBranch("SB", dict(table))


def test_no_lines_of_a_cube_meet() -> None:
    """Three independent facts: a cube can be drawn without a crossing or a line through a node."""
    branch = cube(3)
    places = place_states(branch)
    assert not covers(places)
    assert is_clear(ties_for(branch), np.array([places[name] for name in branch.table]))


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_layout_gives_each_state_a_place_of_its_own(kind: str) -> None:
    for branch in (cube(4), sample("hanoi.json")["SB1"], sample("three-roots.json")["TOOLPLAN"]):
        places = place_anew(branch, kind)
        assert list(places) == list(branch.table)
        assert not covers(places)
        assert place_anew(branch, kind) == places
        assert all(x == int(x) and y == int(y) for x, y in places.values())


def test_layers_lead_from_left_to_right() -> None:
    branch = sample("registration-failures.json")["REGISTRATION"]
    places = place_anew(branch, LAYERS)
    assert min(places, key=lambda name: places[name]) == branch.initial
    graph = graph_of(branch)
    steps = distances(graph.successors, graph.index[branch.initial])
    columns = {places[name][0]: steps[i] for i, name in enumerate(graph.names)}
    assert sorted(columns) == sorted(columns, key=columns.__getitem__)


def test_parts_that_nothing_joins_stand_below_each_other() -> None:
    pair: Tables = {"A": {"go": "B"}, "B": {}, "X": {"go": "Y"}, "Y": {"go": "Z"}, "Z": {}, "O": {}}
    places = place_states(StateBranch("SB", dict(pair), Header(initial="A")))
    heights = [max(places[n][1] for n in part) for part in ("AB", "XYZ", "O")]
    assert heights == sorted(set(heights))


def test_states_without_operations_stand_in_lines() -> None:
    places = place_states(StateBranch("SB", {f"New {i}": {} for i in range(9)}))
    assert len(rows(places)) == 3
    assert not covers(places)


def test_an_empty_branch_has_no_picture() -> None:
    assert place_states(StateBranch("SB", {})) == {}


def test_layout_wins_over_former_and_both_over_what_is_computed() -> None:
    branch = StateBranch(
        "SB",
        {"A": {"x": "B"}, "B": {"x": "C"}, "C": {"x": "D"}, "D": {}},
        fields={"_layout": {"A": [10, 20], "Gone": [0, 0]}},
    )
    places = place_states(branch, {"A": (99.0, 99.0), "B": (300.0, 20.0)})
    assert places["A"] == (10.0, 20.0)
    assert places["B"] == (300.0, 20.0)
    assert abs(places["C"][0] - 300) + abs(places["C"][1] - 20) <= 300
    assert list(places) == ["A", "B", "C", "D"]
    assert not covers(places)


@given(
    st.integers(1, 20),
    st.lists(st.tuples(st.integers(0, 19), st.integers(0, 19)), max_size=45),
    st.booleans(),
    st.integers(0, 19),
)
@settings(max_examples=share_of(60), deadline=None)
def test_no_node_covers_another(
    size: int, edges: list[tuple[int, int]], digits: bool, fixed: int
) -> None:
    names = [f"State_{i:05b}" if digits else f"Place {i}" for i in range(size)]
    table: Tables = {name: {} for name in names}
    for number, (a, b) in enumerate(edges):
        table[names[a % size]][f"Op_{number}"] = names[b % size]
    branch = StateBranch("SB", dict(table))
    places = place_states(branch)
    assert list(places) == names
    assert not covers(places)
    assert places == place_states(StateBranch("SB", dict(table)))
    former = {name: places[name] for name in names[: fixed % (size + 1)]}
    again = place_states(branch, former)
    assert not covers(again)
    assert former.items() <= again.items()


def test_large_graphs_have_a_place_for_every_state() -> None:
    table: Tables = {f"P{i}_{j}": {} for i in range(12) for j in range(12)}
    for i, j in itertools.product(range(12), range(12)):
        for di, dj in ((0, 1), (1, 0)):
            if f"P{i + di}_{j + dj}" in table:
                table[f"P{i}_{j}"][f"go{di}"] = f"P{i + di}_{j + dj}"
    places = place_states(StateBranch("SB", dict(table)))
    assert len(places) == 144
    assert not covers(places)
    assert places == place_states(StateBranch("SB", dict(table)))
    (left, _), (right, _) = places["P0_0"], places["P11_11"]
    assert left < right
    long = [
        name
        for name, ops in table.items()
        for t in ops.values()
        if abs(places[name][0] - places[t][0]) + abs(places[name][1] - places[t][1]) > 700
    ]
    assert not long


def test_eight_disks_have_a_place_each() -> None:
    places = place_states(StateBranch("SB", dict(hanoi(8))))
    assert len(set(places.values())) == 6561
    assert not covers(places)


def test_very_many_new_states_in_a_crowd_are_placed_without_looking_for_long(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Half of a large SB was replaced: its neighbours stand close together."""
    tried: list[int] = []
    ring = taken_places._ring

    def counted(radius: int) -> list[tuple[int, int]]:
        tried.append(radius)
        return ring(radius)

    monkeypatch.setattr(taken_places, "_ring", counted)
    names = [f"State_{n}" for n in range(3000)]
    table = {name: {"a": names[n * 3 % 3000], "b": names[n // 7]} for n, name in enumerate(names)}
    branch = StateBranch("SB", dict(table))
    former = {name: (n % 50 * 150.0, n // 50 * 90.0) for n, name in enumerate(names[::2])}
    places = place_states(branch, former)
    assert not covers(places)
    assert {name: places[name] for name in former} == former
    # Each ring has more places than the one before, and so many are tried in all.
    assert len(tried) < 20_000


def test_very_many_states_stand_in_a_grid_by_their_steps_from_initial() -> None:
    names = [f"S{i}" for i in range(MOST_SPREAD + 1)]
    ring = {one: {"go": two} for one, two in zip(names, [*names[1:], names[0]], strict=True)}
    branch = StateBranch("SB", {**ring, "Alone": {}})
    places = place_states(branch)
    assert is_grid(branch)
    assert list(places) == [*names, "Alone"]
    assert len(set(places.values())) == len(places)
    assert places["S0"] == (0.0, 0.0)
    assert places["Alone"] == max(places.values()), "what no operation leads to comes last"
    right = places["Alone"][0]
    assert 1 < right / max(y for _, y in places.values()) < 2
    assert places["S1"][0] <= places["S2000"][0] <= places["S4000"][0]
    assert not is_grid(StateBranch("SB", dict(list(ring.items())[:60])))


def test_a_grid_takes_little_work_for_each_state() -> None:
    def work(count: int) -> int:
        names = [f"S{i}" for i in range(count)]
        ring = {one: {"go": two} for one, two in zip(names, [*names[1:], names[0]], strict=True)}
        return steps(lambda: place_states(StateBranch("SB", dict(ring))))

    assert work(MOST_SPREAD + 2_000) <= 40 * (MOST_SPREAD + 2_000)


def test_states_that_no_operations_join_are_seen_at_once_to_be_no_triangle() -> None:
    branch = StateBranch("SB", {f"S{i}": {} for i in range(3_000)})
    graph_of(branch)
    assert steps(lambda: in_triangle(branch)) <= 50


def test_places_are_told_from_a_new_layout_as_if_it_were_computed() -> None:
    chance = Random(5)
    answers = set()
    for disks in (2, 3, 4):
        for seed in range(12):
            blueprint = rules.hanoi(disks)
            names = list(blueprint["SB1"].table)
            places = place_states(blueprint["SB1"])
            for gone in chance.sample(names, chance.choice([0, 1, 1, 2 if disks > 3 else 1])):
                blueprint = editing.delete(blueprint, [Address("SB1", gone)])
            if seed % 3 == 0:
                places = place_states(blueprint["SB1"])
            if seed % 4 == 0:
                stays = next(iter(blueprint["SB1"].table))
                places[stays] = (places[stays][0] + chance.choice([0.04, 7.0]), places[stays][1])
            branch = blueprint["SB1"]
            here = {name: places[name] for name in branch.table}
            anew = place_states(branch)
            far = max(max(abs(x - anew[n][0]), abs(y - anew[n][1])) for n, (x, y) in here.items())
            assert is_placed(branch, here) is (far <= TENTH)
            answers.add((len(branch.table) > QUICK, far <= TENTH))
    assert len(answers) == 4
