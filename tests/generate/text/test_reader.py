"""The reader: steps of structured text, in English and German, and what becomes of them."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import ReadError
from smsl_studio.generate.text.expert_text import read_text
from smsl_studio.generate.text.serialization import blueprint_values
from smsl_studio.generate.text.step_numbers import numbered
from smsl_studio.generate.text.step_page import step_page
from smsl_studio.generate.text.step_reader import read_steps
from smsl_studio.generate.text.steps import TextProcedure, TextStep
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.json_form import parse_json, write_json

GERMAN = """# Druckverband

Material:
- ein Verbandpäckchen

1. Der Ersthelfer drückt auf die Wunde, bis die Blutung schwächer wird.
2. Legen Sie einen Verband an. Wenn er durchblutet, dann legen Sie einen zweiten darüber.
3. Warten Sie, bis der Rettungsdienst da ist.

Niemals die Wunde auswaschen.
"""


def steps_of(text: str) -> TextProcedure:
    return numbered(read_steps([read_text(text.encode(), "text.md")]))


def acts(steps: tuple[TextStep, ...]) -> list[object]:
    """The acts of steps, with those of their parts in lists behind them."""
    found: list[object] = []
    for step in steps:
        found += [step.do, *([acts(step.steps)] if step.steps else [])]
    return found


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("1. Fix it.\n2. Drill.\n", ["Fix it", "Drill"]),
        ("Step 1: Fix it\nSchritt 2: Bohren\n", ["Fix it", "Bohren"]),
        ("1. Drill:\n   a) Start\n   b) Stop\n2. Rest", ["Drill", ["Start", "Stop"], "Rest"]),
        ("1 Plan\n1.1 Draw it\n1.2 Look\n2. Go\n", ["Plan", ["Draw it", "Look"], "Go"]),
        ("A\n===\n\n1. x\n2. y\n\nB\n===\n\n1. z\n2. w\n", ["A", ["x", "y"], "B", ["z", "w"]]),
        ("## A\n1. x\n\n## Sources\n1. a book\n2. a page\n\n## B\n1. y\n", ["X", "Y"]),
        ("- one\n- two\n", ["One", "Two"]),
        ("You need:\n- a saw\n\n1. Cut\n2. Rest\n", ["Cut", "Rest"]),
        ("First, open it. It is red. Then close it.", ["Open it", "Close it"]),
        ("| Action | Who |\n|---|---|\n| Mix | nurse |\n| Pour | |\n", ["Mix", "Pour"]),
        ("1. Heat it for approx. 3 s. It\n   is hot.\n2. Go", ["Heat it for approx. 3 s", "Go"]),
        ("1. Wait until the\n   light is on.\n", ["Wait until the light is on"]),
        ("1. Once it is hot, inject it.", ["Wait until it is hot", "Inject it"]),
        ("1. Wait 5 minutes.\n2. Go", ["Wait 5 minutes", "Go"]),
    ],
)  # fmt: skip
def test_steps_are_found(text: str, wanted: list[object]) -> None:
    found = acts(steps_of(text).steps)
    assert str(found).casefold() == str(wanted).casefold()


def test_a_german_text_reads_like_an_english_one() -> None:
    procedure = steps_of(GERMAN)
    press, bandage, wait = procedure.steps
    assert (procedure.title, procedure.language) == ("Druckverband", "de")
    assert (press.who, press.until) == ("Ersthelfer", "die Blutung schwächer wird")
    assert bandage.remedies[0].when == "Er durchblutet"
    assert bandage.remedies[0].back == "again"
    assert (wait.wait, wait.until) == (True, "der Rettungsdienst da ist")
    assert [caution.words for caution in procedure.cautions] == ["Niemals die Wunde auswaschen"]


@pytest.mark.parametrize(
    ("sentence", "back"),
    [
        ("If it slips, then press.", "again"),
        ("If it slips, then go on.", "on"),
        ("If it slips, go back to step 1.", "1"),
        ("Start over if it slips.", "start"),
        ("Wenn es rutscht, dann weiter mit Schritt 1.", "1"),
    ],
)
def test_a_condition_says_where_the_procedure_goes_on(sentence: str, back: str) -> None:
    procedure = steps_of(f"1. Look.\n2. Hold it.\n3. {sentence}\n4. Go.\n")
    _, hold, _ = procedure.steps
    assert [one.back for one in hold.remedies] == [back]
    branch = blueprint_values(procedure)["TEXT"]
    (target,) = branch["State_1x0"].values()
    after = {"again": "State_100", "on": "State_110", "start": "State_000", "1": "State_000"}
    assert target == after[back]


def test_what_a_sentence_says_of_a_step_stands_in_the_blueprint() -> None:
    procedure = steps_of(
        "1. The robot drills within 20 s after the surgeon and the nurse have confirmed "
        "(high risk).\n2. Close it (nurse).\n"
    )
    notes = blueprint_values(procedure)["TEXT"]["_operations"]
    drills, closes = notes.values()
    assert drills["confirm"] == ["surgeon", "nurse"]
    assert (drills["actor"], drills["timeout"], drills["risk"]) == ("robot", 20, "high")
    assert (closes["title"], closes["actor"], closes["roles"]) == ("Close it", "human", ["nurse"])


@pytest.mark.parametrize(
    "text", [GERMAN, "1. A:\n   1. b\n   2. c\n   - If it is hot, cool it.\n2. D"]
)
def test_the_page_of_the_steps_reads_as_the_same_steps(text: str) -> None:
    procedure = steps_of(text)
    page = step_page(procedure, {"stage": "pm"})
    again = numbered(read_steps([read_text(page.encode(), "pm.md")]))
    assert again.steps == procedure.steps
    assert again.title == procedure.title


@pytest.mark.parametrize(
    "text",
    [
        "| No | Action |\n|---|---|\n| 12345 | Mix |\n",
        "1. Look\n2. If it is red:\n   - ...\n",
        '1. Look\n   - source: a, line 0: "x"\n   - source: a, line 99999999999: "x"\n',
        "1. Look\n   - if: a -> b [1..2]\n   - takes: 0 s\n   - risk: no\n   - who: " + "a" * 900,
        "1. " + "a " * 2_000 + "\n",
        "1. (nurse)\n",
    ],
)
def test_odd_marks_and_keys_are_passed_over(text: str) -> None:
    assert len(steps_of(text).steps) == 1


def test_parts_do_not_overtake_each_other() -> None:
    procedure = steps_of("## A\n1. x\n2. y\n\n## B\n1. z\n2. w\n")
    values = blueprint_values(procedure)
    assert values["B"]["_operations"]["Op_Z"]["requires"] == {"TEXT/0": "1"}
    blueprint = read_blueprint(parse_json(write_json(values), "text.json"))
    assert [f for f in inspect(blueprint) if f.severity.value == "E"] == []


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        (b"", "the text is empty"),
        (b" \n\n", "the text is empty"),
        (b"Nothing to do here, and no list either.\n", "no steps were found"),
        (b"1. a\0b\n", "zero byte"),
        (b"1. caf\xe9\n", "not UTF-8"),
        (b"1. " + b"a" * 20_000, "the line has"),
        (b"a\n" * 50_000, "more than 40,000 lines"),
    ],
)
def test_a_text_that_cannot_be_read_has_its_place(raw: bytes, words: str) -> None:
    with pytest.raises(ReadError, match=words) as caught:
        read_steps([read_text(raw, "text.md")])
    assert str(caught.value).startswith("text.md:")
