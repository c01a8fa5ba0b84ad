"""Rules from blueprints: they make them again, and single mistakes in them are named."""

from __future__ import annotations

import random
import re
import tomllib
from collections.abc import Callable
from functools import cache

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import PlanningError
from smsl_studio.generate.examples.learnt import Learnt, RuleException, learnt_from
from smsl_studio.generate.examples.mistakes import repaired
from smsl_studio.generate.examples.table import examples_of
from smsl_studio.generate.rule_file import read_rules
from smsl_studio.generate.rule_states import ruled_branch
from smsl_studio.generate.rules import hanoi_values
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json, write_json
from tests.generate.families import FAMILIES
from tests.generate.seeded_mistakes import KINDS, mistaken

SAMPLES = ("river", "chess", "registration")


def built(values: dict[str, object]) -> Blueprint:
    return read_blueprint(parse_json(write_json(values), "family.json"))


def of_rules(name: str) -> Callable[[], Blueprint]:
    return lambda: smsl.generate_rules(samples_dir() / "rules" / f"{name}.toml").blueprint


def of_values(make: Callable[[], dict[str, object]]) -> Callable[[], Blueprint]:
    return lambda: built(make())


def hanoi(disks: int) -> Callable[[], Blueprint]:
    return lambda: built(dict(hanoi_values(disks)))


REVERSIBLE: dict[str, Callable[[], Blueprint]] = {
    **{f"hanoi {n}": hanoi(n) for n in range(1, 5)},
    **{name: of_rules(name) for name in SAMPLES},
    **{name: of_values(make) for name, make in FAMILIES.items() if name != "lights 3x3"},
}
SHORT = {name: make for name, make in REVERSIBLE.items() if "counter" not in name}
SHORT |= {"three counters": REVERSIBLE["three counters"], "hanoi 5": hanoi(5)}


@cache
def learnt_of(name: str) -> Learnt:
    return smsl.learn(SHORT[name]())


def again(learnt: Learnt) -> Blueprint:
    made = ruled_branch(read_rules(learnt.text.encode(), "learnt.toml"))
    return built(made.values)


@pytest.mark.parametrize("name", SHORT)
def test_learnt_rules_make_the_blueprint_again(name: str) -> None:
    blueprint = SHORT[name]()
    learnt = learnt_of(name)
    assert learnt.exceptions == ()
    made = again(learnt)
    assert smsl.diff_behaviour(blueprint, made).equal
    (here,), (there,) = blueprint, made
    assert here.name == there.name
    assert here.facts(here.initial) == there.facts(there.initial)
    assert here.facts(here.activating) == there.facts(there.activating)
    assert here.num_facts == there.header.num_facts


@pytest.mark.parametrize("name", SHORT)
def test_learnt_rules_are_short_and_have_the_form_of_rules(name: str) -> None:
    learnt = learnt_of(name)
    values = tomllib.loads(learnt.text)
    assert set(values) <= {"sb", "facts", "start", "goal", "never", "rule"}
    assert all(set(rule) <= {"operation", "for", "cases"} for rule in values["rule"])
    cases = [case for rule in values["rule"] for case in rule["cases"]]
    assert all(set(case) <= {"when", "set"} for case in cases)
    assert len(cases) == learnt.cases <= 80
    assert learnt.text.count("\n") <= 120
    assert len(learnt.text.encode()) <= 20_000
    assert max(map(len, re.split(r"\s+", learnt.text))) <= 60


@pytest.mark.parametrize(
    ("name", "cases"),
    [
        ("hanoi 4", 4),
        ("river", 4),
        ("lights 2x3", 2),
        ("three counters", 8),
        ("lamps 5", 2),
        ("tiles 3", 1),
    ],
)
def test_words_of_names_are_parameters(name: str, cases: int) -> None:
    assert learnt_of(name).cases == cases


def test_the_misprints_of_the_paper_come_out() -> None:
    learnt = smsl.learn(smsl.read(samples_dir() / "hanoi.json"))
    assert learnt.exceptions == (
        RuleException("SB1/State_cbb/Op_1b", "missing", None, "State_bbb"),
        RuleException("SB1/State_cbb/Op_1c", "odd", "State_bbb", None),
        RuleException("SB1/State_cbc/Op_2b", "odd", "State_cac", None),
        RuleException("SB1/State_cbc/Op_2a", "missing", None, "State_cac"),
    )
    corrected = smsl.read(samples_dir() / "hanoi-corrected.json")
    assert smsl.diff_behaviour(again(learnt), corrected).equal


@pytest.mark.parametrize("name", REVERSIBLE)
def test_single_mistakes_are_found(name: str) -> None:
    table = examples_of(REVERSIBLE[name]())
    rng = random.Random(name)
    for kind in [*KINDS[:2]] * 4:
        found = mistaken(table, kind, rng)
        assert found is not None
        assert set(repaired(found).all_edges()) == set(table.all_edges()), kind


@pytest.mark.parametrize("name", ["hanoi 2", "hanoi 3", "river", "chess", "ferry of four"])
def test_operations_that_are_too_much_and_wrong_names_are_found(name: str) -> None:
    table = examples_of(REVERSIBLE[name]())
    rng = random.Random(name)
    missed = 0
    for kind in [*KINDS[2:]] * 4:
        found = mistaken(table, kind, rng)
        missed += found is not None and set(repaired(found).all_edges()) != set(table.all_edges())
    # With three ways over for each person, one place may be named as another.
    assert missed <= (name == "ferry of four")


@pytest.mark.parametrize("name", ["hanoi 2", "river", "registration", "ferry of four"])
def test_a_single_mistake_is_the_only_exception(name: str) -> None:
    table = examples_of(REVERSIBLE[name]())
    rng = random.Random(name)
    edge = rng.choice(list(table.all_edges()))
    state = table.names[edge.source]
    deleted = learnt_from(table.with_edge(edge.operation, edge.source, None))
    address, right = f"{table.branch}/{state}/{edge.operation}", table.names[edge.target]
    assert deleted.exceptions == (RuleException(address, "missing", None, right),)
    wrong = rng.choice([values for values in table.states if values != edge.target])
    led = learnt_from(table.with_edge(edge.operation, edge.source, wrong))
    assert led.exceptions == (RuleException(address, "odd", table.names[wrong], right),)


def test_what_rules_cannot_shorten_is_refused() -> None:
    with pytest.raises(PlanningError, match="18 cases for 18 operations"):
        smsl.learn(REVERSIBLE["counter 10"]())
    with pytest.raises(PlanningError, match="there are 2"):
        smsl.learn(smsl.read(samples_dir() / "hfsm.json"))
    rows: dict[str, object] = {"State_{": {"Op_a": "State_b"}, "State_b": {}}
    values: dict[str, object] = {"SB1": {"HEADER": {"NUM_FACTS": 1}, **rows}}
    with pytest.raises(PlanningError, match="braces"):
        smsl.learn(built(values))


def test_names_that_hurt_are_written_so_that_they_can_be_read() -> None:
    names = ["say \"hi\" 'x'", "tab\there", "and", "\u202eback", "= 1", "x" * 70]

    def rows(value: str, other: str) -> dict[str, str]:
        return {f"{name} {value}": f"State_{value}{other}" for name in names}

    table: dict[str, object] = {
        f"State_{a}{b}": rows(other, b) | {"flip": f"State_{a}{'1' if b == '0' else '0'}"}
        for a, other in (("'", '"'), ('"', "'"))
        for b in "01"
    }
    blueprint = built({"S / B": {"HEADER": {"NUM_FACTS": 2}, **table}})
    learnt = smsl.learn(blueprint)
    assert smsl.diff_behaviour(blueprint, again(learnt)).equal


def test_a_file_without_any_order_ends_with_a_sentence() -> None:
    rng = random.Random(4)
    states = [f"State_{a}{b}{c}" for a in "0123456789" for b in "0123456789" for c in "01234"]
    table = {s: {f"Op_{n}": rng.choice(states) for n in range(8)} for s in states}
    with pytest.raises(PlanningError, match="no rule was found"):
        smsl.learn(built({"SB1": {"HEADER": {"NUM_FACTS": 3}, **table}}))
    many = {s: {f"Op_{s}_{n}": states[0] for n in range(2)} for s in states}
    with pytest.raises(PlanningError, match="more than 500 names"):
        smsl.learn(built({"SB1": {"HEADER": {"NUM_FACTS": 3}, **many}}))


def test_a_single_operation_that_changes_nothing_is_odd() -> None:
    """All others change something, though the rules would be shorter with it."""
    table = examples_of(hanoi(1)())
    state = table.states[0]
    (name,) = (one for one, own in table.edges.items() if state not in own)
    found = repaired(table.with_edge(name, state, state))
    assert set(found.all_edges()) == set(table.all_edges())
