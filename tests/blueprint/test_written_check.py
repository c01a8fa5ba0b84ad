"""A state check as the paper writes it, with every term true, false or unknown, and why."""

from __future__ import annotations

from smsl_studio.blueprint.check import CheckResult, Reading, Scene, state_check
from smsl_studio.blueprint.written_check import WrittenCheck, written_check
from tests.plugin_folder import blueprint_of

VALUES = {
    "BASE": {
        "HEADER": {"SUB_SBS": {"SUB": 1}},
        "_facts": {"0": {"name": "Clamp fixed"}},
        "State000": {},
        "State110": {},
    },
    "SUB": {"State_0": {}, "State_1": {}},
}
CLAMP, SUB, THIRD = ("BASE", 0), ("SUB", 0), ("BASE", 2)


def _written(readings: dict[tuple[str, int], Reading], **believed: str) -> WrittenCheck:
    blueprint = blueprint_of(VALUES)
    scene = Scene(readings)
    return written_check(blueprint, state_check(blueprint, "BASE", "State110", scene, believed))


def test_it_reads_as_in_the_paper() -> None:
    check = _written({CLAMP: Reading("1"), SUB: Reading("1"), THIRD: Reading("0")})
    assert (check.name, check.text) == ("C_State110", "lambda s: [f1(s), f2(s), f3(s)]")
    assert [check.text[one.start : one.end] for one in check.terms] == ["f1(s)", "f2(s)", "f3(s)"]
    assert check.truth is True
    assert [one.why for one in check.terms] == [
        "Clamp fixed reads 1", "Fact 2 reads 1 (the check of SUB)", "Fact 3 reads 0",
    ]  # fmt: skip


def test_every_term_says_why() -> None:
    check = _written({CLAMP: Reading("0"), SUB: Reading(None, "it is dark")}, BASE="State110")
    assert [one.truth for one in check.terms] == [False, None, True]
    assert [one.why for one in check.terms] == [
        "Clamp fixed reads 0, not 1",
        "Fact 2 is unknown: SUB/0 in SUB is unknown",
        "Fact 3 reads 0 (believed, nobody senses it)",
    ]
    assert check.truth is False


def test_terms_that_are_left_out_keep_the_others_numbers() -> None:
    blueprint = blueprint_of(VALUES)
    whole = state_check(blueprint, "BASE", "State110", Scene(), {})
    part = CheckResult("BASE", "State110", whole.terms[::2])
    assert written_check(blueprint, part).text == "lambda s: [f1(s), f3(s)]"
    assert written_check(blueprint, CheckResult("BASE", "S", ())).text == "lambda s: []"
