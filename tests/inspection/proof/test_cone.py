"""Leaving SBs out of a search, or looking at all configurations as one set, changes no verdict and
no run."""

from __future__ import annotations

import json
from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.inspection.proof.engines import ENGINES
from smsl_studio.inspection.proof.prove import PlannedRoute, Scope, prove
from smsl_studio.inspection.proof.verdict import PropertyVerdict
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.dispatch.generated import SHAPES, blueprint_values
from tests.inspection.proof.asked_steps import asked_steps
from tests.inspection.proof.brute import drawn_condition


def blueprint(values: dict[str, Any]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values, indent=1), "file.json"))


def verdicts(values: dict[str, Any], scope: Scope) -> tuple[PropertyVerdict, ...]:
    return prove(blueprint(values), _no_route, scope)


def _no_route(goals: Any) -> PlannedRoute | None:
    return None


def drawn_properties(plain: dict[str, Any], chance: Random) -> dict[str, Any]:
    """A hazard now and then, and properties of all kinds that look at configurations."""
    properties: list[dict[str, Any]] = []
    for number in range(10):
        (first, _), (second, _) = (drawn_condition(plain, chance) for _ in range(2))
        kind = ("never", "reachable", "before", "after", "way_back")[number % 5]
        said: Any = first if kind in ("never", "reachable") else [first, second]
        if kind == "way_back":
            within = chance.choice((None, 1, 3))
            said = {"from": first, "to": second} | ({} if within is None else {"within": within})
        properties.append({"name": f"p{number}", kind: said})
    facts = {}
    for name in chance.sample(list(plain), min(2, len(plain))):
        digit = chance.randrange(plain[name]["HEADER"]["NUM_FACTS"])
        states = [state for state in plain[name] if state.startswith("S")]
        facts[f"{name}/{digit}"] = chance.choice(states)[1 + digit]
    hazards = [{"name": "h", "facts": facts}] if chance.random() < 0.5 else []
    return {"_properties": properties, "_hazards": hazards}


def renamed(plain: dict[str, Any], suffix: str) -> dict[str, Any]:
    """The same SBs with other names, which come before or after the others."""
    text = json.dumps(plain)
    for name in plain:
        for end in ('"', "/"):
            text = text.replace(f'"{name}{end}', f'"{suffix}{name}{end}')
    return dict(json.loads(text))


def drawn(seed: int, chance: Random) -> dict[str, Any]:
    """A random blueprint in which something can be left out."""
    plain = blueprint_values(seed, chance.randrange(len(SHAPES)))
    for branch in plain.values():
        if chance.random() < 0.8:
            for note in branch["_operations"].values():
                note.pop("requires", None)
        if chance.random() < 0.4:
            branch["_facts"] = {"0": {"failure": [chance.choice("01")]}}
    if seed % 4 == 0:
        plain |= renamed(blueprint_values(seed + 1, chance.randrange(2)), chance.choice("0Z"))
    return plain


def compare(seed: int) -> None:
    """Answer the same questions in all ways."""
    chance = Random(seed)
    plain = drawn(seed, chance)
    values = {**drawn_properties(plain, chance), **plain}
    failures = seed % 3 == 0
    whole = verdicts(values, Scope(10_000, failures, 10**9))
    ways = (((), 0), (("diagram",), 0), (ENGINES, 10**9), (("arrays",), 0))
    for engines, near in ways[:2] if failures else ways:  # arrays begin at one start
        found = verdicts(values, Scope(10_000, failures, 0, engines, near))
        for one, other in zip(found, whole, strict=True):
            assert one.verdict == other.verdict, one.name
            assert (one.configurations is None) or one.configurations == other.configurations
            run, wanted = one.counterexample, other.counterexample
            assert (run is None) == (wanted is None)
            if run is None or wanted is None:
                continue
            if run.path == wanted.path and (failures or not run.path):
                continue  # the starts may differ
            assert run == wanted, one.name


@pytest.mark.parametrize("seed", range(share_of(80)))
def test_cones_and_diagrams_change_no_verdict_and_no_run(seed: int) -> None:
    compare(seed)


@pytest.mark.parametrize("seed", range(share_of(40)))
def test_what_fails_elsewhere_changes_no_verdict_and_no_length(seed: int) -> None:
    """SBs that can fail and do not touch a claim: the SBs of the claim are looked at first."""
    chance = Random(f"elsewhere {seed}")
    plain = drawn(seed, chance)
    others = renamed(blueprint_values(seed + 7, 0), "Z")
    for branch in others.values():
        branch["_facts"] = {"0": {"failure": [chance.choice("01")]}}
    values = {**drawn_properties(plain, chance), **plain, **others}
    whole = verdicts(values, Scope(20_000, True, 10**9))
    for one, other in zip(verdicts(values, Scope(20_000, True, 0)), whole, strict=True):
        if other.verdict != "unknown":
            assert one.verdict == other.verdict, one.name
            runs = one.counterexample, other.counterexample
            lengths = {None if run is None else len(run.path) for run in runs}
            assert len(lengths) == 1, one.name


def test_many_roots_that_can_fail_are_not_combined(monkeypatch: pytest.MonkeyPatch) -> None:
    """24 of them have 282 thousand million configurations, and a claim is about one."""
    asked = asked_steps(monkeypatch)
    root = {"_facts": {"0": {"failure": ["f"]}}, "State_0": {"on": "State_1"},
            "State_1": {"off": "State_0"}, "State_f": {"mend": "State_0"}}  # fmt: skip
    properties = [
        {"name": "never", "never": "R0 = 1 and R1 = 0 and R0 = 0"},
        {"name": "back", "way_back": {"from": "R0 = f", "to": "R0 = 0", "within": 1}},
        {"name": "reached", "reachable": "R0 = f"},
    ]
    roots: dict[str, Any] = {f"R{number}": root for number in range(24)}
    found = verdicts({"_properties": properties, **roots}, Scope(failures=True))
    assert [one.verdict for one in found] == ["holds"] * 3
    assert len(asked) < 100


def test_a_failure_that_is_found_is_told_though_the_whole_is_too_large() -> None:
    root = {"_facts": {"0": {"failure": ["f"]}}, "State_0": {"on": "State_1"}, "State_1": {},
            "State_f": {}}  # fmt: skip
    names = [f"R{number}" for number in range(24)]
    together = " and ".join(f"{name} = 1" for name in names[:6])
    values = {"_properties": [{"name": "p", "never": together}], **dict.fromkeys(names, root)}
    (one,) = verdicts(values, Scope(2_000, True, engines=()))
    assert (one.verdict, one.bound is None) == ("fails", False)
    assert one.counterexample is not None
    assert len(one.counterexample.path) == 6
    # As one set the whole is not too large, and a run begins where six are on and another failed.
    (one,) = verdicts(values, Scope(2_000, True))
    assert (one.verdict, one.bound, one.engine) == ("fails", None, "diagram")
    assert one.counterexample is not None
    assert one.counterexample.path == ()


def many_subs(count: int, states: int) -> dict[str, Any]:
    """A base with a line of states, each with one sub-SB more than the one before."""
    ends = ["0" * count] + ["1" * n + "0" * (count - n) for n in range(1, count + 1)]
    base: dict[str, Any] = {
        f"S{one}": {"on": f"S{ends[n + 1]}"} if n < count else {} for n, one in enumerate(ends)
    }
    for n in range(count):
        base[f"S{ends[n + 1]}"]["off"] = f"S{ends[n]}"
    header = {
        "INITIAL": f"S{ends[0]}", "ACTIVATING": f"S{ends[-1]}", "NUM_FACTS": count,
        "SUB_SBS": {f"SUB{n:02}": n for n in range(count)},
    }  # fmt: skip
    values: dict[str, Any] = {"BASE": {"HEADER": header, **base}}
    for n in range(count):
        line = {f"S{m}": {"go": f"S{m + 1}", "back": f"S{max(m - 1, 0)}"} for m in range(states)}
        line[f"S{states - 1}"] = {"back": f"S{states - 2}"}
        values[f"SUB{n:02}"] = {"HEADER": {"NUM_FACTS": 1}, **line}
    return values


def test_sub_sbs_that_a_question_does_not_reach_cost_nothing() -> None:
    values = many_subs(12, 8)
    properties = [
        {"name": "far", "reachable": "BASE in S111111111111"},
        {"name": "apart", "never": "SUB03 in S3 and SUB07 in S2"},
        {"name": "order", "never": "SUB07 in S7 and SUB03 in S2"},
    ]
    counts = {(): None, ENGINES: sum(7 ** (12 - on) for on in range(13))}
    for engines, count in counts.items():
        scope = Scope(1_000, engines=engines)
        far, apart, order = verdicts({"_properties": properties, **values}, scope)
        assert (far.verdict, far.configurations, far.bound) == ("holds", count, None)
        assert far.engine == ("diagram" if engines else "explicit")
        assert (order.verdict, order.bound) == ("holds", None)
        run = apart.counterexample
        assert run is not None
        assert [str(one) for one in run.path] == [
            "SUB03/S0/go", "SUB03/S1/go", "SUB03/S2/go", "SUB07/S0/go", "SUB07/S1/go",
        ]  # fmt: skip


def test_an_operation_that_is_left_out_still_comes_first_by_its_address() -> None:
    values = {
        "_properties": [{"name": "p", "never": "Z in S1"}],
        "Z": {"HEADER": {"NUM_FACTS": 1, "SUB_SBS": {"A": 0}}, "S0": {"up": "S1"}, "S1": {}},
        "A": {"HEADER": {"NUM_FACTS": 1}, "S0": {"on": "S1"}, "S1": {"off": "S0"}},
    }
    for small in (0, 100):
        (found,) = verdicts(values, Scope(small=small))
        assert found.counterexample is not None
        assert [str(one) for one in found.counterexample.path] == ["A/S0/on"]
        assert found.counterexample.end == {"Z": "S1", "A": "S1"}


def test_a_sub_sb_whose_fact_is_required_is_looked_at() -> None:
    base = {"HEADER": {"NUM_FACTS": 1, "SUB_SBS": {"A": 0}}, "S0": {"up": "S1"}, "S1": {}}
    sub = {"HEADER": {"NUM_FACTS": 2, "ACTIVATING": "S11"}}
    sub |= {"S00": {"on": "S11"}, "S11": {"off": "S00"}, "S01": {"on": "S11"}}
    values = {
        "_properties": [{"name": "p", "reachable": "B in S1"}],
        "Z": base,
        "A": sub,
        "B": {
            "HEADER": {"NUM_FACTS": 1},
            "_operations": {"go": {"requires": {"A/1": "1"}}},
            "S0": {"go": "S1"},
            "S1": {},
        },
    }
    (found,) = verdicts(values, Scope(small=0))
    assert found.verdict == "holds"


def test_failures_are_answered_from_one_set_too() -> None:
    values = {
        "_properties": [
            {"name": "stuck", "way_back": {"from": "A/0 = x", "to": "A in S0"}},
            {"name": "free", "never": "A/0 = x and B in S3"},
        ],
        "A": {
            "HEADER": {"NUM_FACTS": 1, "INITIAL": "S0", "ACTIVATING": "S1"},
            "_facts": {"0": {"failure": ["x"]}},
            "_operations": {"mend": {"requires": {"B/0": "3"}}},
            "S0": {"go": "S1"},
            "S1": {},
            "Sx": {"mend": "S1"},
        },
        "B": {"HEADER": {"NUM_FACTS": 1}, **{f"S{n}": {"on": f"S{n + 1}"} for n in range(3)},
              "S3": {}},
    }  # fmt: skip
    for engines in ((), ("diagram",)):
        stuck, free = verdicts(values, Scope(failures=True, small=0, near=0, engines=engines))
        assert (stuck.verdict, free.verdict) == ("fails", "fails")
        assert stuck.engine == free.engine == (engines[0] if engines else "explicit")
        assert stuck.counterexample is not None
        assert (stuck.counterexample.path, stuck.counterexample.start["A"]) == ((), "Sx")
        assert free.counterexample is not None
        assert free.counterexample.end == {"A": "Sx", "B": "S3"}
        assert free.counterexample.start == {"A": "Sx", "B": "S3"}, "B may be anywhere"
        assert free.configurations == 12
