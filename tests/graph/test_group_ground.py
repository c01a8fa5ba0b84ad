"""A tidy drawing leaves no state in the frame of a group to which it does not belong."""

from __future__ import annotations

import json

from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint.editing import set_layout
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.graph.tidied import tidied
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of

Places = dict[str, tuple[float, float]]


@st.composite
def drawings(draw: st.DrawFn) -> tuple[StateBranch, Places, list[str]]:
    """An SB with groups, any places, and the states that are selected (none: all)."""
    count = draw(st.integers(3, 12))
    names = [f"State_{at}x" for at in range(count)]
    ends = st.tuples(st.sampled_from(names), st.sampled_from(names))
    table: dict[str, dict[str, str]] = {name: {} for name in names}
    for number, (a, b) in enumerate(draw(st.lists(ends, max_size=20))):
        table[a][f"go{number}"] = b
    order = draw(st.permutations(names))
    first = draw(st.integers(1, count - 1))
    groups = {"1": {"title": "One", "states": order[:first]}}
    if draw(st.booleans()) and count - first > 1:
        groups["2"] = {"title": "Two", "states": order[first : first + 1]}
    spot = st.tuples(st.integers(-600, 600), st.integers(-400, 400))
    layout: dict[str, object] = {"_groups": groups} | {name: list(draw(spot)) for name in names}
    pinned = draw(st.lists(st.sampled_from(names), max_size=2, unique=True))
    layout["_pinned"] = dict.fromkeys(pinned, True)
    values = {"S": {"HEADER": {}, **table, "_layout": layout}}
    branch = read_blueprint(parse_json(json.dumps(values), "test.json"))["S"]
    chosen = draw(st.lists(st.sampled_from(names), max_size=count, unique=True))
    return branch, place_states(branch), chosen


def strangers(branch: StateBranch, places: Places) -> set[str]:
    """The states outside all groups whose node touches the frame of a group."""
    grouped = {name for group in branch.drawn.groups.values() for name in group.states}
    found = set()
    for group in branch.drawn.groups.values():
        xs = [places[name][0] for name in group.states]
        ys = [places[name][1] for name in group.states]
        left, right = min(xs) - 54.0 - 14.0, max(xs) + 54.0 + 14.0
        top, bottom = min(ys) - 27.0 - 14.0 - 24.0, max(ys) + 27.0 + 14.0
        found |= {
            name for name, (x, y) in places.items()
            if left < x + 54.0 and x - 54.0 < right and top < y + 27.0 and y - 27.0 < bottom
        } - grouped  # fmt: skip
    return found


@settings(max_examples=share_of(40))
@given(drawings())
def test_a_state_that_tidy_moves_is_in_no_group_of_others(
    drawing: tuple[StateBranch, Places, list[str]],
) -> None:
    branch, before, chosen = drawing
    places = tidied(branch, before, chosen)
    moving = (set(chosen) or set(branch.table)) - branch.notes.pinned
    assert not strangers(branch, places) & moving
    still = set(branch.table) - moving
    assert all(places[name] == before[name] for name in still), "nothing else moves"
    apart = {
        (a, b) for a in moving for b in branch.table if a < b
        and abs(places[a][0] - places[b][0]) < 108.0 and abs(places[a][1] - places[b][1]) < 54.0
    }  # fmt: skip
    assert not apart or still, "no state covers another"


@settings(max_examples=25)
@given(drawings())
def test_tidy_of_a_drawing_with_groups_rests(
    drawing: tuple[StateBranch, Places, list[str]],
) -> None:
    branch, before, _ = drawing
    places = tidied(branch, before)
    assert tidied(branch, places) == places


def test_a_state_beside_the_members_of_a_group_is_led_out() -> None:
    names = ["Idle", "Ready", "Moving", "Halted"]
    values = {
        "S": {
            "HEADER": {},
            "Idle": {"go": "Ready"},
            "Ready": {"move": "Halted"},
            "Halted": {"on": "Moving"},
            "Moving": {"poll": "Moving", "back": "Idle"},
            "_layout": {"_groups": {"1": {"title": "Motion", "states": ["Ready", "Moving"]}}},
        }
    }
    blueprint = read_blueprint(parse_json(json.dumps(values), "test.json"))
    row = {name: (200.0 * at, 0.0) for at, name in enumerate(names)}
    row["Halted"], row["Moving"] = (400.0, 0.0), (600.0, 0.0)
    branch = set_layout(blueprint, "S", row)["S"]
    assert strangers(branch, row) == {"Halted"}
    assert not strangers(branch, tidied(branch, row))
    assert not strangers(branch, tidied(branch, row, ["Ready", "Moving", "Halted"]))
