"""What ``verify.py`` asks of names, seats, addresses, guards, and of the words of events."""

from __future__ import annotations

import json
from itertools import permutations
from pathlib import Path
from random import Random
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.person_names import same_name
from smsl_studio.front.verifier import told_again
from smsl_studio.seal.strict_json import base64_text
from tests.approval import ADA, DOOR, EVE, Member, entry, register_of
from tests.front.bundle_tampers import LOG, is_believed, program, whole
from tests.front.test_bundle_approvals import record_files_of
from tests.front.told_runs import ToldRun, told_runs
from tests.plugin_folder import blueprint_of
from tests.runlog.impossible import OPERATORS, Story, impossible

Json = Any
NAMES = (
    "Ada", "ADA ", "A\u200bda", "\u2800Ada\u3164", "Ad\ufe0fa", "Ad\U000e0101a", "A\u034fda",
    "Ren\u00e9", "Rene\u0301", "Rene\u200d\u0301", "Rene\t\u0301", "Stra\u00dfe", "\u1e9e",
    "\u0390", "\u1160", "\u180b", "\u17b4x", "\x00x", "\u212b", "\ufb01n", "\u0930\u093f",
)  # fmt: skip
SIGNS = "aAe\u00e9\u0301 \t\u200b\u200d\ufe0f\U000e0100\u034f\u115f\u3164\u2800\u180e\u00df\ufb01"


def test_a_name_is_folded_as_the_program_folds_it() -> None:
    random = Random("names")
    drawn = ["".join(random.choices(SIGNS, k=random.randint(0, 6))) for _ in range(500)]
    for name in [*NAMES, *drawn]:
        assert program().same(name) == same_name(name), ascii(name)
    assert program().same("A\u200bda") == program().same("ada")
    assert program().same("Rene\u200d\u0301") == program().same("Ren\u00e9")


def test_invisible_characters_make_no_second_person(tmp_path: Path) -> None:
    twin = Member(f"\u3164{ADA.person.upper()}\u200b", "surgeon", bytes(range(60, 92)))
    blueprint = blueprint_of(DOOR)
    policy = f'persons = 2\nregister_key = "{base64_text(EVE.public)}"\n'.encode()
    for other, believed in ((twin, False), (Member("Cy", "surgeon", twin.private), True)):
        files = record_files_of(blueprint, (ADA, other))
        files |= {"policy.toml": policy, "register.json": register_of(entry(ADA), entry(other))}
        assert is_believed(files) is believed, ascii(other.person)


def test_each_wish_gets_an_offer_of_its_own() -> None:
    random = Random("seats")
    for _ in range(400):
        offers = [set(random.sample("abcd", random.randint(0, 3))) for _ in range(5)]
        wishes = random.choices("abcd", k=random.randint(0, 5))
        fits = any(
            all(wish in offer for wish, offer in zip(wishes, some, strict=True))
            for some in permutations(offers, len(wishes))
        )
        assert program().each(wishes, offers) is fits, (wishes, offers)


def test_many_seats_take_no_long_time() -> None:
    """All orders of twelve seats would take hours."""
    roles = [f"role {n}" for n in range(12)]
    assert program().each(roles, [{role} for role in reversed(roles)])
    assert not program().each(roles, [{role} for role in [*roles[1:], roles[1]]])
    assert not program().each(["surgeon"] * 12, [{"surgeon"}] * 11 + [{"nurse"}])


def _story_of(values: Json, folder: Path) -> tuple[Story, smsl.Blueprint]:
    blueprint = blueprint_of(values)
    smsl.run(blueprint, log=folder / "run.jsonl")
    return Story.of((folder / "run.jsonl").read_bytes()), blueprint


def test_an_address_has_one_spelling(tmp_path: Path) -> None:
    values = json.loads(json.dumps(DOOR).replace('"open"', '"op~en"').replace("State_1", "Open~_1"))
    story, blueprint = _story_of(values, tmp_path)
    assert told_again(story.raw(), blueprint) == ""
    for written, raw in (("op~0en", "op~en"), ("Open~0_1", "Open~_1")):
        for kind in ("operation_started", "operation_ended", "state_checked", "committed"):
            forged = Story.of(story.raw())
            forged.events = [
                json.loads(json.dumps(one).replace(written, raw)) if one["event"] == kind else one
                for one in story.events
            ]
            if forged.events != story.events:
                assert told_again(forged.raw(), blueprint), (kind, raw)


def test_an_operation_that_a_guard_closes_does_not_begin(tmp_path: Path) -> None:
    story, blueprint = _story_of(DOOR, tmp_path)
    (at,) = story.at("operation_started")
    address, t = story.events[at]["address"], story.events[at]["t"]
    told = {"event": "costs_changed", "t": t, "costs": {}, "faults": []}
    closed = {**told, "closed": {address: "it is locked"}}
    story.events.insert(at, closed)
    assert told_again(story.raw(), blueprint)
    story.events.insert(at + 1, {**told, "closed": {address: ""}})
    assert told_again(story.raw(), blueprint) == ""


@pytest.fixture(scope="module")
def taken_over(tmp_path_factory: pytest.TempPathFactory) -> ToldRun:
    """A run that was given back."""
    (run,) = told_runs(range(33, 34), tmp_path_factory.mktemp("told"))
    return run


def test_a_run_is_given_back_where_it_is_located(taken_over: ToldRun) -> None:
    story = Story.of(taken_over.raw)
    assert told_again(story.raw(), taken_over.blueprint) == ""
    (at,) = story.at("given_back")
    for there in ({}, {"Nowhere": "State"}):
        story.events[at]["configuration"] = there
        assert told_again(story.raw(), taken_over.blueprint), there


EFFECTS = ("stopped", "taken_over", "given_back", "resumed", "operation_pruned", "disturbed")


@pytest.mark.parametrize("effect", EFFECTS)
def test_a_command_has_its_effect_at_once(effect: str, taken_over: ToldRun) -> None:
    story = Story.of(taken_over.raw)
    for at in story.at(effect):
        late = Story.of(taken_over.raw)
        del late.events[at]
        assert told_again(late.raw(), taken_over.blueprint), at


def test_what_an_operation_has_reached_is_checked_before_the_next_one_ends(tmp_path: Path) -> None:
    (operator,) = [one for one in OPERATORS if one.__name__ == "part_of_a_step_not_checked"]
    run = told_runs(range(8, 9), tmp_path)[0]
    story = impossible(Story.of(run.raw), operator, Random("8"))
    assert story is not None
    assert told_again(story.raw(), run.blueprint)


@pytest.mark.parametrize("value", [None, 5, "x", ["x"], {"x": 5}, {"x": None}])
def test_a_header_with_other_procedures_is_refused_and_no_traceback(value: Json) -> None:
    files = dict(whole())
    story = Story.of(files[LOG])
    story.header["procedures"] = value
    assert not is_believed({**files, LOG: story.raw()})
