"""Bounds of time and memory, and engines that give up: what is told then."""

from __future__ import annotations

import json
from itertools import product
from typing import Any

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.exploration import explore
from smsl_studio.front.proof import prove
from smsl_studio.graph.joint import array_search, reach
from smsl_studio.graph.joint.array_search import ArrayBound
from smsl_studio.inspection.proof.arrays import ArraySpace
from smsl_studio.inspection.proof.engines import Engines
from smsl_studio.inspection.proof.prove import Scope
from smsl_studio.inspection.proof.prove import prove as proved
from smsl_studio.inspection.proof.verdict import PropertyVerdict
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.stop import EffortBounds, Stopped, bounded, heed, heeding

KINDS: list[dict[str, Any]] = [
    {"name": "never", "never": "C0 in S5 and C3 in S1"},
    {"name": "safe", "never": "C0 in S7 and C1 in S0"},
    {"name": "reachable", "reachable": "C2 in S6"},
    {"name": "before", "before": ["C0 in S3", "C1 in S4"]},
    {"name": "after", "after": ["C0 in S2", "C0 in S3"]},
    {"name": "way_back", "way_back": {"from": "C3 in S7", "to": "C3 in S0"}},
]


def counters(count: int = 4, states: int = 8) -> dict[str, Any]:
    """Counters of which each, but the first, goes on only where the one before it is ahead."""
    values: dict[str, Any] = {}
    for n, m in product(range(count), range(states)):
        branch = values.setdefault(f"C{n}", {"HEADER": {"NUM_FACTS": 1}, "_operations": {}})
        table = branch.setdefault(f"S{m}", {})
        if m + 1 < states:
            table["go"] = f"S{m + 1}"
        if m:
            table["back"] = f"S{m - 1}"
        if n and m + 1 < states:
            branch["_operations"][f"S{m}/go"] = {"requires": {f"C{n - 1}/0": str((m + n) % states)}}
    return {"_properties": KINDS, **values}


def blueprint(values: dict[str, Any]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values, indent=1), "file.json"))


def answers(scope: Scope) -> dict[str, PropertyVerdict]:
    found = proved(blueprint(counters()), lambda goals: None, scope)
    return {one.name: one for one in found}


@pytest.mark.parametrize(
    ("effort", "words"),
    [({"seconds": 1e-9}, "1e-09 seconds"), ({"megabytes": 1}, "1 MB of memory")],
)
def test_a_bound_of_effort_is_told_for_each_kind(effort: dict[str, Any], words: str) -> None:
    proof = prove(blueprint(counters()), **effort)
    assert {(one.verdict, one.bound) for one in proof.verdicts} == {("unknown", words)}
    assert len(proof.findings) == len(KINDS)
    for one in proof.findings:
        assert words in one.message
    found = explore(blueprint(counters()), **effort)
    assert (found.ours.bound, found.ours.clean) == (words, False)


def test_what_was_looked_at_is_told() -> None:
    line = {f"S{n:02}": {"on": f"S{n + 1:02}"} for n in range(40)} | {"S40": {}}
    far = {"_properties": [{"name": "far", "never": "A in S30"}], "A": line}
    (finding,) = prove(blueprint(far), 10).findings
    assert finding.message.endswith("10 configurations; 10 configurations were looked at")


def test_a_stop_comes_before_a_bound() -> None:
    def stop() -> None:
        raise Stopped

    with heeding(stop), bounded(EffortBounds(1e-9)), pytest.raises(Stopped):
        heed()
    heed()


def test_arrays_answer_where_a_diagram_grows_too_large(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = answers(Scope(small=10**9))
    diagrams = answers(Scope(small=0, near=0))
    monkeypatch.setattr(reach, "LEAST_WORK", 10)
    monkeypatch.setattr(reach, "SHARE", 10**9)
    arrays = answers(Scope(small=0, near=0))
    engines = {name: (one.engine, arrays[name].engine) for name, one in diagrams.items()}
    # Arrays look back for no kind, so these two wait for the diagram.
    assert engines.pop("after") == engines.pop("way_back") == ("diagram", "diagram")
    assert set(engines.values()) == {("diagram", "arrays")}
    for name, one in wanted.items():
        for other in (diagrams[name], arrays[name]):
            assert (one.verdict, one.counterexample) == (other.verdict, other.counterexample)
            assert other.configurations in (None, one.configurations)


def test_the_bound_of_arrays_is_told_where_nothing_else_answers(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(reach, "LEAST_WORK", 10)
    monkeypatch.setattr(reach, "SHARE", 10**9)
    monkeypatch.setattr(array_search, "ArrayBound", lambda: ArrayBound(500, 10**6))
    far = " and ".join(f"C{n} in S7" for n in range(4))
    asked = [{"name": "far", "never": far}, {"name": "near", "never": "C0 in S2"}]
    values = {**counters(), "_properties": asked}
    found = proved(blueprint(values), lambda goals: None, Scope(limit=100, small=0, near=0))
    one, near = found
    assert (one.verdict, one.bound, one.engine) == (
        "unknown", "500 configurations in arrays", "arrays"
    )  # fmt: skip
    assert 100 < (one.configurations or 0) <= 500
    assert (near.verdict, near.counterexample is None) == ("fails", False)


def test_engines_of_many_parts_are_forgotten() -> None:
    values: dict[str, Any] = {}
    for n in range(8):
        pair = counters(2, 5)
        pair.pop("_properties")
        values |= json.loads(json.dumps(pair).replace('"C', f'"P{n}C'))
    engines = Engines(blueprint(values), ())
    names = [{f"P{n}C0", f"P{n}C1"} for n in range(8)]
    found = [engines.engine(one, False) for one in names]
    assert all(found)
    assert engines.engine(names[7], False) is found[7], "it is kept"
    assert engines.engine(names[0], False) is not found[0], "it was forgotten"
    arrays = Engines(blueprint(values), (), ("arrays",))
    first = arrays.engine(names[0], False)
    assert isinstance(first, ArraySpace)
    count = first.count
    assert arrays.engine(names[1], False) is not first
    assert first.count == count > 1, "its arrays are made anew"
