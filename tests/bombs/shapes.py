"""Blueprints that are valid or nearly valid, and have far too many of one thing.

Each function makes one with ``n`` of that thing; the size of its text grows in proportion to ``n``.
"""

from __future__ import annotations

from typing import Any

Json = Any
Values = dict[str, Any]
LONG = 9_000
"""Nearly as long as a name may be."""


def _ring(n: int, name: str = "State{:07}") -> dict[str, Json]:
    """States, each of which leads to the next."""
    names = [name.format(i) for i in range(n)]
    return {one: {"go": two} for one, two in zip(names, [*names[1:], *names[:1]], strict=True)}


def _pair(**header: Json) -> dict[str, Json]:
    """An SB of two states."""
    return {"HEADER": header, "State0": {"on": "State1"}, "State1": {"off": "State0"}}


def empty_sbs(n: int) -> Values:
    return {f"B{i}": {} for i in range(n)}


def small_sbs(n: int) -> Values:
    return {f"B{i}": {"S": {"o": "S"}} for i in range(n)}


def paired_sbs(n: int) -> Values:
    return {f"B{i}": _pair(INITIAL="State0", ACTIVATING="State1", NUM_FACTS=1) for i in range(n)}


def states_alone(n: int) -> Values:
    return {"B": {f"State{i:07}": {} for i in range(n)}}


def states_in_a_ring(n: int) -> Values:
    return {"B": _ring(n)}


def unreachable_ring(n: int) -> Values:
    return {"B": {"State_begin": {}, **_ring(n), "State_end": {}}}


def unreachable_tree(n: int) -> Values:
    """Each state that cannot be reached is the only way into the next two."""
    tree = {f"T{i}": {"a": f"T{2 * i + 1}", "b": f"T{2 * i + 2}"} for i in range(n)}
    return {"B": {"S": {"o": "S"}, **tree}}


def trap(n: int) -> Values:
    return {"B": {"HEADER": {"ACTIVATING": "G"}, "G": {"o": "G"}, "S": {"o": "T0"}, **_ring(n)}}


def operations_of_one_state(n: int) -> Values:
    return {"B": {"S": {f"o{i}": "T" for i in range(n)}, "T": {"back": "S"}}}


def operations_to_all(n: int) -> Values:
    states = [f"S{i}" for i in range(n)]
    return {"B": {"S": {f"o{i}": name for i, name in enumerate(states)}} | _ring(n, "S{}")}


def parallel_operations(n: int) -> Values:
    width = 40
    ring = _ring(n // width + 1)
    return {"B": {s: {f"o{i}": o["go"] for i in range(width)} for s, o in ring.items()}}


def self_loops(n: int) -> Values:
    return {"B": {f"S{i}": {"stay": f"S{i}", "go": f"S{(i + 1) % n}"} for i in range(n)}}


def dangling(n: int) -> Values:
    return {"B": {f"State{i:06}": {"go": f"Stale{i:06}"} for i in range(n)}}


def dangling_among_sbs(n: int) -> Values:
    return {f"B{i}": {"StateA": {"go": "StateB"}, "StateC": {}} for i in range(n)}


def alike_states(n: int) -> Values:
    return {"B": {k: {} for i in range(n // 2 + 1) for k in (f"item{i:06}", f"Item{i:06}")}}


def alike_sbs(n: int) -> Values:
    return {k: _pair() for i in range(n // 2 + 1) for k in (f"arm{i}", f"Arm{i}")}


def alike_operations(n: int) -> Values:
    names = [k for i in range(n // 2 + 1) for k in (f"go{i}", f"GO{i}")]
    return {"B": {"S": dict.fromkeys(names, "S")}}


def expanding_names(n: int) -> Values:
    """Each character stands for eighteen others where look-alikes are sought."""
    return {"B": {"\ufdfa" * 400 + f"{i}": {} for i in range(n)}}


def long_states(n: int) -> Values:
    return {"B": _ring(n, "State{:0" + str(LONG) + "}")}


def long_operations(n: int) -> Values:
    names = [f"{i:0{LONG}}" for i in range(n)]
    return {"B": {"S0": dict.fromkeys(names, "S1"), "S1": {"back": "S0"}}}


def long_sbs(n: int) -> Values:
    return {f"{i:0{LONG}}": _pair() for i in range(n)}


def many_facts(n: int) -> Values:
    """Thousands of facts, and as many operations that change one of them or all."""
    width = 4_000
    states = [f"State_{'01'[i % 2] * (width - i % 7)}{'0' * (i % 7)}" for i in range(14)]
    table: dict[str, Json] = {one: {} for one in states}
    for i in range(n):
        table[states[i % 14]][f"o{i}"] = states[(i * 5 + 3) % 14]
    return {"B": {"HEADER": {"NUM_FACTS": width}, **table}}


def equal_facts(n: int) -> Values:
    return {"B": {f"{i}_0101": {"go": f"{(i + 1) % n}_0101"} for i in range(n)}}


def odd_lengths(n: int) -> Values:
    return {"B": {"HEADER": {"NUM_FACTS": 2}, **{f"State{'0' * (i % 5)}{i}": {} for i in range(n)}}}


def mislabelled(n: int) -> Values:
    """Half of all operations do what the other half's name says."""
    table: dict[str, Json] = {"State00": {}, "State01": {}, "State10": {}, "State11": {}}
    for i in range(n):
        table["State00"][f"a{i}"] = "State01"
        table["State10"][f"a{i}"] = "State11"
        table["State01"][f"a{i}"] = "State11"
        table["State00"][f"b{i}"] = "State10"
    return {"B": {"HEADER": {"NUM_FACTS": 2}, **table}}


def conditional(n: int) -> Values:
    """Every operation does something else in each state."""
    states = [f"State{i:08b}" for i in range(64)]
    table: dict[str, Json] = {one: {} for one in states}
    for i in range(n):
        table[states[i % 64]][f"o{i // 64 % 997}_{i // 63808}"] = states[i * 7 % 64]
    return {"B": {"HEADER": {"NUM_FACTS": 8}, **table}}


def known_subs(n: int) -> Values:
    """One SB with a sub-SB on each of its facts."""
    subs = {f"B{i}": i for i in range(n)}
    below = {name: {"S0": {"o": "S1"}, "S1": {"o": "S0"}} for name in subs}
    zeros, ones = ("State_" + digit * n for digit in "01")
    return {"A": {"HEADER": {"SUB_SBS": subs}, zeros: {"o": ones}, ones: {"o": zeros}}, **below}


def unknown_subs(n: int) -> Values:
    return {"A": _pair(SUB_SBS={f"B{i}": i for i in range(n)})}


def unknown_subs_each(n: int) -> Values:
    return {f"B{i}": _pair(SUB_SBS={f"C{i}": 0}) for i in range(n)}


def near_subs(n: int) -> Values:
    """Sub-SBs that do not exist, and as many SBs with nearly their names."""
    return {"A": _pair(SUB_SBS={f"Sub{i}x": i for i in range(n)})} | {
        f"Sub{i}y": {} for i in range(n)
    }


def listed_subs(n: int) -> Values:
    return {"A": _pair(SUB_SBS=[{f"B{i}": i} for i in range(n)]), "B1": _pair()}


def repeated_subs(n: int) -> Values:
    return {"A": _pair(SUB_SBS=[{"B": i} for i in range(n)]), "B": _pair()}


def crowded_digit(n: int) -> Values:
    return {"A": _pair(SUB_SBS={f"B{i}": 0 for i in range(n)})} | empty_sbs(n)


def sub_chain(n: int) -> Values:
    chain = {f"B{i}": _pair(NUM_FACTS=1, SUB_SBS={f"B{i + 1}": 0}) for i in range(n)}
    return {**chain, f"B{n}": _pair(NUM_FACTS=1)}


def sub_chain_backwards(n: int) -> Values:
    return dict(reversed(sub_chain(n).items()))


def sub_cycle(n: int) -> Values:
    return {f"B{i}": _pair(SUB_SBS={f"B{(i + 1) % n}": 0}) for i in range(n)}


def sub_cycles(n: int) -> Values:
    """Every SB stands below every other within a group: far more cycles than SBs."""
    found: Values = {}
    for i in range(n):
        group = i - i % 12
        subs = {f"B{group + k}": k for k in range(12) if group + k != i}
        found[f"B{i}"] = {
            "HEADER": {"NUM_FACTS": 12, "SUB_SBS": subs},
            "State_" + "0" * 12: {"o": "State_" + "1" * 12},
            "State_" + "1" * 12: {},
        }
    return found


def sub_diamonds(n: int) -> Values:
    """Each layer of two shares the two of the next: two to the power of n ways down."""
    found: Values = {}
    for i in range(n):
        for side in "lr":
            subs = {"SUB_SBS": {f"l{i + 1}": 0, f"r{i + 1}": 1}} if i + 1 < n else {}
            found[f"{side}{i}"] = {
                "HEADER": {"NUM_FACTS": 2, **subs},
                "State00": {"a": "State10", "b": "State01"},
                "State10": {"b": "State11"},
                "State01": {"a": "State11"},
                "State11": {"c": "State00"},
            }
    return found


def shared_sub(n: int) -> Values:
    return {f"B{i}": _pair(NUM_FACTS=1, SUB_SBS={"S": 0}) for i in range(n)} | {"S": _pair()}


def header_keys(n: int) -> Values:
    return {"B": _pair(**{f"K{i}": i for i in range(n)})}


def header_keys_each(n: int) -> Values:
    return {f"B{i}": _pair(INITAL="State0", NUMFACTS=2) for i in range(n)}


def wrong_initials(n: int) -> Values:
    return {f"B{i}": _pair(INITIAL="State2", ACTIVATING="X", NUM_STATES=7) for i in range(n)}


def fact_notes(n: int) -> Values:
    return {"B": {**_pair(), "_facts": {str(i): {"name": f"f{i}"} for i in range(n)}}}


def state_notes(n: int) -> Values:
    return {"B": {**_pair(), "_states": {f"S{i}": {"title": "x"} for i in range(n)}}}


def operation_notes(n: int) -> Values:
    return {"B": {**_pair(), "_operations": {f"o{i}": {"cost": 2} for i in range(n)}}}


def true_notes(n: int) -> Values:
    """A ring whose states and operations are all spoken of."""
    ring = _ring(n)
    states = {name: {"title": f"Step {i}", "safe": True} for i, name in enumerate(ring)}
    operations = {f"{name}/go": {"cost": 2, "repeatable": True} for name in ring}
    return {"B": {**ring, "_states": states, "_operations": operations | {"go": {"cost": 1}}}}


def odd_notes(n: int) -> Values:
    """Every word of every note is of the wrong kind."""
    words = {"title": 1, "cost": "x", "risk": 5, "confirm": {}, "timeout": -1, "nonsense": None}
    return {"B": {**_pair(), "_operations": {f"o{i}": words for i in range(n)}}}


def drawn_notes(n: int) -> Values:
    """A ring with a note on each state, every other one in a group."""
    ring = _ring(n)
    notes = {str(i): {"text": "x", "at": [i, 8], "state": name} for i, name in enumerate(ring)}
    groups = {str(i): {"title": "g", "states": [name]} for i, name in enumerate(ring) if i % 2}
    return {"B": {**ring, "_notes": notes, "_layout": {"_groups": groups}}}


def odd_drawn_notes(n: int) -> Values:
    """Notes on states that are not there, and groups that all want the same states."""
    ring = _ring(9)
    notes = {str(i): {"text": 5, "at": [i, "x"], "state": f"gone{i}"} for i in range(n)}
    groups = {str(i): {"title": [], "states": [*ring, "gone"]} for i in range(n)}
    return {"B": {**ring, "_notes": notes, "_layout": {"_groups": groups}}}


def odd_words(n: int) -> Values:
    """One note with very many words that nobody knows."""
    return {"B": {**_pair(), "_operations": {"on": {f"w{i}": i for i in range(n)}}}}


def requirements(n: int) -> Values:
    wanted = {f"B{i}/0": "1" for i in range(n)}
    return {"B": {**_pair(), "_operations": {"on": {"requires": wanted}}}}


def requirements_of_all(n: int) -> Values:
    ring = _ring(n)
    notes = {f"{name}/go": {"requires": {"C/0": "0", "B/6": "0"}} for name in ring}
    return {"B": {**ring, "_operations": notes}, "C": _pair()}


def layout(n: int) -> Values:
    return {"B": {**_pair(), "_layout": {f"S{i}": [i, -i] for i in range(n)}}}


def hazards(n: int) -> Values:
    found = [{"name": f"h{i}", "facts": {"B/0": "1", f"X{i}/0": "1"}} for i in range(n)]
    return {"_hazards": found, "B": _pair()}


def hazards_of_states(n: int) -> Values:
    """As many hazards as states, which name the values of one fact."""
    found = [{"name": f"h{i}", "facts": {"B/6": str(i % 10)}} for i in range(n)]
    return {"_hazards": found, "B": {"HEADER": {"NUM_FACTS": 7}, **_ring(n)}}


def wide_hazard(n: int) -> Values:
    facts = {f"X{i}/0": "1" for i in range(n)}
    return {"_hazards": [{"name": "h", "facts": facts}], "B": _pair()}


def odd_hazards(n: int) -> Values:
    return {"_hazards": list(range(n)), "B": _pair()}


def levels(n: int) -> Values:
    return {"_levels": {f"B{i}/o": "human" for i in range(n)}, **small_sbs(n)}


def odd_levels(n: int) -> Values:
    return {"_levels": {f"B{i}": [] for i in range(n)}, "B": _pair()}


def unknown_fields(n: int) -> Values:
    return {**{f"_x{i}": i for i in range(n)}, "B": _pair()}


def fields_everywhere(n: int) -> Values:
    ring = {name: {"_x": 1, **o} for name, o in _ring(n).items()}
    return {"B": ring}


def numbers(n: int) -> Values:
    return {"_x": [i % 10 for i in range(n)], "B": _pair()}


def empty_maps(n: int) -> Values:
    return {"_x": [{} for _ in range(n)], "B": _pair()}


def deep_values(n: int) -> Values:
    deep: Json = 1
    for i in range(50):
        deep = [deep] if i % 2 else {"a": deep}
    return {"_x": [deep] * n, "B": _pair()}


def long_text(n: int) -> Values:
    return {"_x": "x" * n, "B": {**_pair(), "_states": {"State0": {"note": "y " * n}}}}


def strange_text(n: int) -> Values:
    """Characters that are written as escapes, of two, three and four bytes."""
    return {"_x": '\u0001\u2028é状🧠\\"' * n, "B": _pair()}


def wrong_kinds(n: int) -> Values:
    return {"B": {f"S{i}": {"go": i, "_x": None} for i in range(n)}}


def wrong_sbs(n: int) -> Values:
    return {f"B{i}": i for i in range(n)}


def wrong_states(n: int) -> Values:
    return {"B": {f"S{i}": [i] for i in range(n)}}


def careful_sbs(n: int) -> Values:
    """SBs as large as those that are drawn and laid out with the greatest care."""
    names = [f"S{i}" for i in range(27)]
    table = {
        one: {f"o{k}": names[(i * 3 + k * 7) % 27] for k in range(4)} for i, one in enumerate(names)
    }
    return {f"B{i}": table for i in range(n // 100 + 1)}
