"""All configurations together: against a plain search, and by hand."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from itertools import product
from typing import Any

import pytest

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.front.exploration import ExploredSpace, explore
from smsl_studio.inspection.explorer.as_set import counted
from smsl_studio.inspection.explorer.explorer import MOST, ExploredMode, explored_coupled
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.dispatch.naive import Config
from tests.inspection.proof.brute import Brute, starts_of

Steps = Callable[[Config], Iterable[tuple[str, Config]]]


def blueprint(values: dict[str, Any]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values, indent=1), "file.json"))


def reached(start: Config, steps: Steps) -> dict[tuple[tuple[str, str], ...], tuple[str, ...]]:
    """Each configuration with the shortest way to it, of equally short ones the least."""
    found = {tuple(sorted(start.items())): tuple[str, ...]()}
    layer = [start]
    while layer:
        ways: dict[tuple[tuple[str, str], ...], tuple[str, ...]] = {}
        for here in layer:
            way = found[tuple(sorted(here.items()))]
            for address, after in steps(here):
                key = tuple(sorted(after.items()))
                if key not in found:
                    ways[key] = min(ways.get(key, (*way, address)), (*way, address))
        found |= ways
        layer = [dict(key) for key in ways]
    return found


def free_steps(plain: dict[str, Any]) -> Steps:
    def steps(here: Config) -> Iterable[tuple[str, Config]]:
        for sb, state in here.items():
            for name, target in plain[sb][state].items():
                yield f"{sb}/{state}/{name}", {**here, sb: target}

    return steps


def coupled_steps(brute: Brute) -> Steps:
    def steps(here: Config) -> Iterable[tuple[str, Config]]:
        for sb in brute.naive.plain:
            for name, _ in brute.naive.edges(sb, here[sb]):
                carried = brute.naive.carry(here, sb, name, {})
                if carried is not None:
                    yield f"{sb}/{here[sb]}/{name}", carried[0]

    return steps


def held_against(
    mode: ExploredMode, plain: dict[str, Any], start: Config, steps: Steps, couples: bool
) -> None:
    """Hold one mode against a search that knows every configuration and every way back."""
    ways = reached(start, steps)
    assert mode.configurations == len(ways)
    links = [
        (base, digit, sub)
        for base in plain
        for sub, digit in plain[base]["HEADER"].get("SUB_SBS", {}).items()
    ]
    wrong: dict[tuple[str, str, str, str], int] = {}
    for key, way in ways.items():
        here = dict(key)
        for base, digit, sub in links:
            on = here[base][1 + digit] == "1"
            if on != (here[sub] == plain[sub]["HEADER"]["ACTIVATING"]):
                pair = base, here[base], sub, here[sub]
                wrong[pair] = min(wrong.get(pair, len(way)), len(way))
    assert mode.disagreement_count == len(wrong)
    if couples:
        assert not wrong
    for place in mode.disagreements:
        (base, above), (sub, below) = sorted(
            place.configuration.items(), key=lambda item: list(plain).index(item[0])
        )
        pairs = ((base, above, sub, below), (sub, below, base, above))
        assert len(place.path) in [wrong[pair] for pair in pairs if pair in wrong]
    subs = {sub for _, _, sub in links}
    goal = {sb: plain[sb]["HEADER"]["ACTIVATING"] for sb in plain if sb not in subs}
    good = {key for key in ways if goal.items() <= dict(key).items()}
    while more := {
        key
        for key in ways
        if key not in good
        and any(tuple(sorted(after.items())) in good for _, after in steps(dict(key)))
    }:
        good |= more
    assert mode.trap_count == len(ways) - len(good)
    for place in mode.traps:
        key = tuple(sorted(place.configuration.items()))
        assert key not in good
        assert tuple(map(str, place.path)) == ways[key]
    lengths = [len(place.path) for place in mode.traps]
    nearest = sorted(len(ways[key]) for key in ways if key not in good)
    assert lengths == nearest[:MOST]


@pytest.mark.parametrize("seed", range(share_of(40)))
def test_a_plain_search_finds_the_same(seed: int) -> None:
    plain = blueprint_values(seed)
    whole = blueprint(plain)
    starts = starts_of(lambda: explore(whole), whole)
    if not starts:
        return
    (start,) = starts
    found = explore(whole)
    brute = Brute(plain, start)
    held_against(found.ours, plain, start, coupled_steps(brute), True)
    initial = {sb: plain[sb]["HEADER"]["INITIAL"] for sb in plain}
    size = 1
    for sb in plain:
        size *= len(plain[sb]) - 1
    if size < 5_000:
        bare = {sb: {k: v for k, v in plain[sb].items() if k.startswith("S")} for sb in plain}
        full = {sb: {"HEADER": plain[sb]["HEADER"], **bare[sb]} for sb in plain}
        held_against(found.free, full, initial, free_steps(full), False)


def chain(count: int, back: bool) -> dict[str, Any]:
    """An SB of some states in a row, from the first to the last, and back if it is wanted."""
    table: dict[str, Any] = {f"S{n}": {"on": f"S{n + 1}"} for n in range(count - 1)}
    table[f"S{count - 1}"] = {"back": "S0"} if back else {}
    return table


def test_independent_sbs_are_counted_and_not_listed() -> None:
    names = [f"B{n}" for n in range(30)]
    found = explore(blueprint({name: chain(10, True) for name in names}))
    assert found.ours.configurations == found.free.configurations == 10**30
    assert found.ours.clean
    assert found.free.clean


def with_traps() -> ExploredSpace:
    """Two SBs that move by themselves. In each one state is a trap."""
    table = {"S0": {"go": "S1", "fall": "S2"}, "S1": {}, "S2": {}}
    values = {name: {"HEADER": {"ACTIVATING": "S1"}, **table} for name in ("A", "B")}
    return explore(blueprint(values))


def test_traps_are_told_the_nearest_first() -> None:
    found = with_traps().ours
    assert (found.configurations, found.trap_count) == (9, 5)
    first = found.traps[0]
    assert (first.configuration, [str(one) for one in first.path]) == (
        {"A": "S2", "B": "S0"},
        ["A/S0/fall"],
    )
    told = {tuple(one.configuration.items()) for one in found.traps}
    states = ("S0", "S1", "S2")
    wanted = {(("A", a), ("B", b)) for a, b in product(states, states) if "S2" in (a, b)}
    assert told == wanted


def test_more_than_a_hundred_traps_are_counted() -> None:
    table = {**chain(200, False), "S199": {}, "HEADER": {"ACTIVATING": "S0"}}
    mode = explore(blueprint({"A": table})).ours
    assert (mode.trap_count, len(mode.traps)) == (199, MOST)
    assert mode.as_json()["more"] == 99


def test_the_limit_is_told_and_traps_are_not_known_then() -> None:
    values = {"A": {"HEADER": {"SUB_SBS": {"B": 0}}, "S0": {"go": "S1"}, "S1": {"no": "S0"}}}
    values["B"] = {"S0": {"on": "S1"}, "S1": {"off": "S0"}}
    mode = explore(blueprint(values), 1).ours
    assert mode.bound == "1 configurations"
    assert not mode.clean
    assert mode.as_json()["bound"] == mode.bound


@pytest.mark.parametrize("seed", range(0, 40, 2))
def test_one_set_of_all_configurations_gives_the_same(seed: int) -> None:
    whole = blueprint(blueprint_values(seed))
    try:
        one_by_one = explored_coupled(whole, 100_000, few=10**9)
    except RunRefused:
        return
    found = counted(Hierarchy(whole), MOST)
    assert found.configurations == one_by_one.configurations
    assert found.traps == one_by_one.trap_count
    ways = {tuple(place.configuration.items()): place.path for place in one_by_one.traps}
    assert len(found.nearest) == len(ways)
    assert [len(path) for _, path in found.nearest] == [len(one) for one in ways.values()]
    if found.traps <= MOST:
        assert {tuple(one.items()): path for one, path in found.nearest} == ways


def test_a_thousand_million_configurations_are_counted() -> None:
    """Nothing of them is stored. One counter may stand still for ever: that is a trap."""
    values: dict[str, Any] = {}
    for n in range(9):
        table: dict[str, dict[str, str]] = {f"S{m}": {} for m in range(10)}
        for m in range(9):
            table[f"S{m}"]["go"], table[f"S{m + 1}"]["back"] = f"S{m + 1}", f"S{m}"
        values[f"C{n}"] = {"HEADER": {"NUM_FACTS": 1}, **table}
    values["C0"]["S0"]["lost"] = "Sx"
    values["C0"] = {**values["C0"], "Sx": {}}
    values["C0"]["HEADER"] = {"NUM_FACTS": 1, "INITIAL": "S0", "ACTIVATING": "S9"}
    # They are one part, because an operation of each requires a fact of the next.
    for n in range(8):
        values[f"C{n}"]["_operations"] = {"S0/go": {"requires": {f"C{n + 1}/0": "0"}}}
    found = explored_coupled(blueprint(values), 1_000)
    assert (found.bound, found.configurations, found.trap_count) == ("", 11 * 10**8, 10**8)
    assert [len(place.path) for place in found.traps[:2]] == [1, 2]
