"""Five procedures as plain searches, for rules that were written from the documentation alone.

Each gives the operations of a state with the states they lead to. They share no line with the
package.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

State = tuple[str, ...]
Steps = Iterator[tuple[str, State]]


def searched(start: State, steps: Callable[[State], Steps]) -> dict[str, dict[str, str]]:
    """The table of all states that are reached."""
    table: dict[str, dict[str, str]] = {}
    found = [start]
    for state in found:
        row = table["State_" + "".join(state)] = {}
        for operation, after in steps(state):
            row[operation] = "State_" + "".join(after)
            if after not in found:
                found.append(after)
    return table


def sluice(state: State) -> Steps:
    """A lock for ships: two gates and the water between them."""
    upper, lower, water = state
    if upper == "open":
        yield "close_upper_gate", ("shut", lower, water)
    elif lower == "shut" and water == "high":
        yield "open_upper_gate", ("open", lower, water)
    if lower == "open":
        yield "close_lower_gate", (upper, "shut", water)
    elif upper == "shut" and water == "down":
        yield "open_lower_gate", (upper, "open", water)
    if upper == lower == "shut":
        if water == "down":
            yield "fill", (upper, lower, "high")
        else:
            yield "drain", (upper, lower, "down")


def syringes(state: State) -> Steps:
    """Three syringes: empty, filled, labelled, used. One at a time is filled without a label."""
    for at, own in enumerate(state):

        def turned(value: str, at: int = at) -> State:
            return (*state[:at], value, *state[at + 1 :])

        name = f"syringe {at + 1}"
        if own == "E" and "F" not in state:
            yield f"fill_{name}", turned("F")
        if own == "F":
            yield f"empty_{name}", turned("E")
            yield f"label_{name}", turned("L")
        if own == "L" and set(state[:at]) <= {"U"}:
            yield f"use_{name}", turned("U")


def robots(state: State) -> Steps:
    """Two robots on a ring of four stations, never at the same one."""
    for at, station in enumerate(state):
        for word, step in (("clockwise", 1), ("counterclockwise", -1)):
            place = "ABCD"[("ABCD".index(station) + step) % 4]
            if place != state[1 - at]:
                after = (place, state[1]) if at == 0 else (state[0], place)
                yield f"robot{at + 1}_{word}", after


def jugs(state: State) -> Steps:
    """Two jugs of 3 and 5 litres."""
    small, large = map(int, state)
    into_large, into_small = min(small, 5 - large), min(large, 3 - small)
    for operation, after in {
        "fill_small": (3, large),
        "fill_large": (small, 5),
        "empty_small": (0, large),
        "empty_large": (small, 0),
        "pour_small_into_large": (small - into_large, large + into_large),
        "pour_large_into_small": (small + into_small, large - into_small),
    }.items():
        if after != (small, large):
            yield operation, (str(after[0]), str(after[1]))


def theatre(state: State) -> Steps:
    """An operating theatre: two doors, the patient, the light, the staff."""
    anteroom, inner, patient, light, staff = state
    if anteroom == "o":
        yield "close_anteroom_door", ("s", inner, patient, light, staff)
        if patient in "wa":
            word, place = ("anteroom", "a") if patient == "w" else ("ward", "w")
            yield f"patient_to_{word}", (anteroom, inner, place, light, staff)
    else:
        if inner == "s":
            yield "open_anteroom_door", ("o", inner, patient, light, staff)
        word, place = ("in", "i") if staff == "o" else ("out", "o")
        yield f"staff_{word}", (anteroom, inner, patient, light, place)
    if inner == "o":
        yield "close_theatre_door", (anteroom, "s", patient, light, staff)
        if patient == "a":
            yield "patient_to_theatre", (anteroom, inner, "t", "u", staff)
        if patient == "t":
            yield "patient_to_anteroom", (anteroom, inner, "a", light, staff)
    elif anteroom == "s" and (light == "c" or patient == "t"):
        yield "open_theatre_door", (anteroom, "o", patient, light, staff)
    if light == "u" and patient != "t" and staff == "i":
        yield "clean_light", (anteroom, inner, patient, "c", staff)
