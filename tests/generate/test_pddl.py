"""Blueprints from PDDL, beside a plain planner, and files that are wrong."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.errors import ReadError, UsageError
from smsl_studio.shipped import samples_dir
from tests.generate.drawn_problems import DOMAINS, domain_file, drawn_problem
from tests.generate.plain_planner import PlainPlanner

PDDL = samples_dir() / "pddl"
SAMPLES = {"trays": "trays-3", "ward": "ward-4", "lamps": "lamps-4", "crew": "crew-2"}


def compare(domain: Path, problem: Path) -> None:
    """The generated blueprint is that of the plain planner, state by state."""
    made = smsl.generate_pddl(domain, problem)
    (branch,) = made.blueprint
    states, rows, goals, costs = PlainPlanner(domain.read_text(), problem.read_text()).search()
    assert branch.name == "SB1"
    assert list(branch.table) == [f"State_{at}" for at in range(len(states))]
    assert [dict(row) for row in branch.table.values()] == [
        {name: f"State_{target}" for name, target in row.items()} for row in rows
    ]
    assert [list(row) for row in branch.table.values()] == [list(row) for row in rows]
    changing = {a for state in states for a in state ^ states[0]}
    names = [branch.fact_name(digit) for digit in range(len(changing))]
    assert sorted(names) == sorted(" ".join(atom) for atom in changing)
    for at, state in enumerate(states):
        held = {" ".join(atom) for atom in state}
        wanted = tuple("1" if name in held else "0" for name in names)
        assert not names or branch.facts(f"State_{at}") == wanted
    assert made.goal_reached == bool(goals)
    assert branch.initial == "State_0"
    if goals:
        assert branch.activating == f"State_{goals[0]}"
    noted = {s for s, note in branch.fields["_states"].items() if note.get("note") == "goal"}
    assert noted == {f"State_{at}" for at in goals[1:]}
    told = branch.fields.get("_operations", {})
    if told:
        assert {name: note["cost"] for name, note in told.items()} == costs
    else:
        assert not any(costs.values())
    assert (made.states, made.operations) == (len(states), sum(map(len, rows)))


@pytest.mark.parametrize("domain", SAMPLES)
def test_the_samples_are_those_of_a_plain_planner(domain: str) -> None:
    compare(PDDL / f"{domain}.pddl", PDDL / f"{SAMPLES[domain]}.pddl")


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("domain", DOMAINS)
def test_drawn_problems_are_those_of_a_plain_planner(
    domain: str, seed: int, tmp_path: Path
) -> None:
    file = tmp_path / "p.pddl"
    file.write_text(drawn_problem(domain, random.Random(f"{domain} {seed}")))
    compare(domain_file(domain), file)


DOMAIN = """\
(define (domain d)
  (:requirements :adl)
  (:types a b - thing)
  (:predicates (p ?x - thing) (q))
  (:action go :parameters (?x - a) :precondition (not (p ?x)) :effect (p ?x)))
"""
PROBLEM = "(define (problem x) (:domain d) (:objects o - a u - b) (:init (p u)) (:goal (p o)))\n"


def made(tmp_path: Path, domain: str, problem: str) -> smsl.Blueprint:
    files = tmp_path / "d.pddl", tmp_path / "p.pddl"
    for file, text in zip(files, (domain, problem), strict=True):
        file.write_text(text)
    return smsl.generate_pddl(*files).blueprint


def test_words_have_no_capitals_and_it_says_where_it_comes_from(tmp_path: Path) -> None:
    blueprint = made(tmp_path, DOMAIN.upper(), PROBLEM)
    (branch,) = blueprint
    assert dict(branch.table["State_0"]) == {"go_o": "State_1"}
    assert branch.fact_name(0) == "p o"
    origin = blueprint.fields["_origin"]
    assert (origin["how"], origin["from"]) == ("pddl", "d.pddl, p.pddl")
    assert len(origin["digest"]) == 64


@pytest.mark.parametrize(
    ("old", "new", "where", "words"),
    [
        (":adl", ":fluents", "2:18", "requirement ':fluents' is not supported"),
        ("a b - thing", "a - b b - a", "3:11", "kind of itself"),
        ("a b - thing", "a - a", "3:11", "kind of itself"),
        ("(?x - a)", "(?x - c)", "5:28", "no type 'c'"),
        ("(not (p ?x))", "(> (p ?x) 1)", "5:50", "a comparison of numbers is not supported"),
        ("(not (p ?x))", "(not (r ?x))", "5:55", "no predicate 'r'"),
        ("(not (p ?x))", "(not (p ?y))", "5:58", "no parameter ?y"),
        ("(not (p ?x))", "(not (p ?x ?x))", "5:55", "p has 1 arguments, and here are 2"),
        (":effect (p ?x)", ":effect (assign (p) 3)", "5:71", "the effect assign is not supported"),
        (":effect (p ?x)", ":effect", "5:63", "nothing stands behind :effect"),
        (":action go", ":durative-action go", "5:3", ":durative-action is not supported"),
        ("(:action", "(:derived (q) (p ?x)) (:action", "5:3", ":derived is not supported"),
        ("(p ?x)))", "(p ?x))", "1:1", "a bracket is not closed"),
        ("(define", "\u202e(define", "1:1", "no word of PDDL"),
    ],
)
def test_a_wrong_domain_has_a_place(
    tmp_path: Path, old: str, new: str, where: str, words: str
) -> None:
    assert old in DOMAIN
    with pytest.raises(ReadError) as told:
        made(tmp_path, DOMAIN.replace(old, new, 1), PROBLEM)
    assert str(told.value).startswith(f"{tmp_path / 'd.pddl'}:{where}: "), told.value
    assert words in told.value.sentence


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("(:domain d)", "(:domain e)", "another domain than 'd'"),
        ("o - a", "o - w", "no type 'w'"),
        ("o - a", "o o - a", "the object 'o' stands twice"),
        ("(p u)", "(r u)", "no predicate 'r'"),
        ("(p u)", "(p w)", "no object 'w'"),
        ("(p u)", "(at 3 (p u))", "a timed literal is not supported"),
        ("(:goal (p o))", "(:goal (p o)) (:constraints (q))", ":constraints is not supported"),
        ("(:goal (p o))", "(:goal (preference l (p o)))", "preference is not supported"),
        ("(:goal (p o))", "", "the section :goal is missing"),
        ("(:goal (p o))", "(:goal (p o)) (:metric maximize (q))", "a metric other than"),
    ],
)
def test_a_problem_that_does_not_fit_has_a_place(
    tmp_path: Path, old: str, new: str, words: str
) -> None:
    with pytest.raises(ReadError) as told:
        made(tmp_path, DOMAIN, PROBLEM.replace(old, new, 1))
    assert str(told.value).startswith(f"{tmp_path / 'p.pddl'}:1:")
    assert words in told.value.sentence


@pytest.mark.parametrize("text", ["(" * 900_000, "(a " * 300_000, ")" * 9, "", "x", "()", "(a)(b)"])
def test_brackets_without_end_are_one_error(tmp_path: Path, text: str) -> None:
    with pytest.raises(ReadError):
        made(tmp_path, text, PROBLEM)
    with pytest.raises(ReadError):
        made(tmp_path, DOMAIN, text)


def test_bombs_end_with_a_sentence(tmp_path: Path) -> None:
    many = " ".join(f"o{n}" for n in range(60))
    wide = DOMAIN.replace("(?x - a)", "(?x ?y ?z ?u ?v - a)")
    with pytest.raises(UsageError, match="more than"):
        made(tmp_path, wide, PROBLEM.replace("o - a", f"o {many} - a"))
    deep = DOMAIN.replace("(not (p ?x))", "(forall (?1 ?2 ?3 ?4 ?5 - a) (not (p ?x)))")
    with pytest.raises(UsageError, match="more than"):
        made(tmp_path, deep, PROBLEM.replace("o - a", f"o {many} - a"))
    with pytest.raises(UsageError, match="more than 200,000 states"):
        made(tmp_path, DOMAIN, PROBLEM.replace("o - a", f"o {many} - a"))


def test_two_actions_of_one_name_are_refused(tmp_path: Path) -> None:
    twice = DOMAIN.replace("(:action go", "(:action go_o :effect (q)) (:action go")
    with pytest.raises(ReadError, match="two actions would have the name go_o"):
        made(tmp_path, twice, PROBLEM)
