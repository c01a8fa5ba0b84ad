"""``generate text``: samples, by hand, replay, and inputs that do not fit."""

from __future__ import annotations

import json
import shutil
import tomllib
from collections.abc import Mapping
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint import editing
from smsl_studio.shipped import samples_dir
from tests.cases import case
from tests.cli.shell import Answer, Shell
from tests.generate.text.answering import completion, sent, server

TEXTS = samples_dir() / "texts"
LAMP = """# Lamp

1. Plug it in.
2. Switch it on until it is warm.
   - If it smokes, pull the plug.
"""


@pytest.fixture
def lamp(tmp_path: Path) -> Path:
    file = tmp_path / "lamp.md"
    file.write_text(LAMP)
    return file


@pytest.mark.parametrize(("name", "people"), [("femoroplasty", True), ("first-aid", False)])
def test_a_sample_becomes_a_blueprint_that_reaches_its_goal(
    shell: Shell, tmp_path: Path, name: str, people: bool
) -> None:
    out = tmp_path / "made" / f"{name}.json"
    hardware = ("--hardware", str(TEXTS / f"{name}-hardware.md"))
    words = ("generate", "text", str(TEXTS / f"{name}.md"), *hardware, "-o", str(out))
    answer = shell(*words, "--format", "json")
    assert answer.status == 0, answer.err
    assert (answer.json["uncited"], answer.json["missing"], answer.json["goal"]) == ([], [], True)
    checked = shell("check", str(out), "--format", "json")
    assert checked.status == 0
    assert "R32" not in {one["rule"] for one in checked.json["files"][0]["findings"]}
    script = out.parent / "people.jsonl"
    assert script.exists() == people
    asked = ("--script", str(script)) if people else ()
    ran = shell("run", str(out), "--world", "table", *asked, "--format", "json")
    assert ran.lines[-1]["reason"] == "goal_reached"
    assert "GENERATED, NOT INSPECTED" in ran.err
    before = {path.name: path.read_bytes() for path in out.parent.rglob("*") if path.is_file()}
    assert shell(*words).status == 0
    after = {path.name: path.read_bytes() for path in out.parent.rglob("*") if path.is_file()}
    assert after == before


@pytest.mark.parametrize("name", ["femoroplasty", "first-aid"])
def test_recorded_answers_of_a_server_make_a_sample_also_after_wrong_ones(
    shell: Shell, tmp_path: Path, name: str
) -> None:
    """Each stage but the last answers wrongly first: no JSON, another schema, a word of its own, a
    citation of what stands nowhere. What was wrong is the next question."""
    read, out = tmp_path / "read", tmp_path / "made" / "a.json"
    hardware = ("--hardware", str(TEXTS / f"{name}-hardware.md"))
    text = ("generate", "text", str(TEXTS / f"{name}.md"), *hardware)
    assert shell(*text, "-o", str(read / "a.json")).status == 0
    good = [one["answer"] for one in json.loads((read / "answers.json").read_text())["answers"]]
    answers = iter([
        "I am sorry.", '{"title": "x"}', f"Here it is:\n```json\n{good[0]}\n```",
        '{"needs": 3}', good[1],
        good[2].replace(f"{name}.md", "another.md"), '{"LAMP": 3}',
        good[2].replace("State_0", "State_9", 1), good[2],
        *good[3:],
    ])  # fmt: skip
    with server(lambda handler, _: sent(handler, completion(next(answers)))) as (url, prompts):
        made = shell(*text, "-o", str(out), "--provider", url, "--format", "json")
    assert made.status == 0, made.err
    assert "the answer holds no JSON object" in prompts[1]
    assert "steps: Field required" in prompts[2]
    assert "the words do not stand there: another.md" in prompts[6]
    assert (made.json["uncited"], made.json["goal"]) == ([], True)
    assert shell("check", str(out)).status == 0
    script = out.parent / "people.jsonl"
    asked = ("--script", str(script)) if script.exists() else ()
    ran = shell("run", str(out), "--world", "table", *asked, "--format", "json")
    assert ran.lines[-1]["reason"] == "goal_reached"
    theirs = json.loads((read / "a.json").read_text())
    ours = json.loads(out.read_text())
    assert (theirs.pop("_origin")["model"], ours.pop("_origin")["model"]) == ("reader", "m")
    assert ours == theirs


def test_each_output_says_how_it_was_made(shell: Shell, lamp: Path, tmp_path: Path) -> None:
    out = tmp_path / "made" / "lamp.json"
    assert shell("generate", "text", str(lamp), "-o", str(out)).status == 0
    made = out.parent
    origin = json.loads((made / "psm.json").read_text())["_origin"]
    assert (origin["stage"], origin["model"], origin["from"]) == ("psm", "reader", "lamp.md")
    assert tomllib.loads((made / "him.toml").read_text())["_origin"]["stage"] == "him"
    assert '_origin: {"stage": "pm"' in (made / "pm.md").read_text()
    functions = sorted((made / "rmm").iterdir())
    assert functions[0].name == "LAMP.Op_Plug.py"
    assert "_origin = {'stage': 'rmm'" in functions[0].read_text()
    report = tmp_path / "lamp.html"
    assert shell("report", str(out), "-o", str(report)).status == 0
    assert "“Plug it in.” lamp.md, line 3" in report.read_text()


def test_by_hand_asks_stage_by_stage_and_takes_what_lies_there(
    shell: Shell, lamp: Path, tmp_path: Path
) -> None:
    read, hand = tmp_path / "read", tmp_path / "hand"
    assert shell("generate", "text", str(lamp), "-o", str(read / "lamp.json")).status == 0
    out = tmp_path / "made" / "lamp.json"
    call = ("generate", "text", str(lamp), "-o", str(out), "--by-hand", str(hand))
    for stage, file in (("pm", "pm.md"), ("him", "him.toml"), ("psm", "psm.json"), ("rmm", "rmm")):
        answer = shell(*call)
        assert answer.status == 1
        assert f"{file} is missing: stage {stage}" in answer.err
        assert (hand / f"{stage}.prompt.md").exists()
        if stage == "pm":
            assert "lamp.md 3: 1. Plug it in." in (hand / "pm.prompt.md").read_text()
        given = read / file
        (shutil.copytree if given.is_dir() else shutil.copy)(given, hand / file)
    assert shell(*call).status == 0
    values = json.loads(out.read_text())
    assert values.pop("_origin")["model"] == "by hand"
    theirs = json.loads((read / "psm.json").read_text())
    theirs.pop("_origin")
    assert values == theirs


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"_imports": ["/etc/passwd"]}, "_imports is not allowed"),
        ({"LAMP": {"State_0": {"a": "State_9"}, "State_1": {}}}, "R02"),
        ({"LAMP": 3}, "must be an object"),
        (
            {"LAMP": {"State_0": {"a": "State_1"}, "State_1": {},
                      "_operations": {"a": {"binding": {"blueprint": "x.json", "goal": "A/b"}}}}},
            "binds no code",
        ),
        (
            {"LAMP": {"State_0": {"a": "State_1"}, "State_1": {},
                      "_sources": {"a": [{"file": "lamp.md", "line": 3, "words": "Explode"}]}}},
            "the words do not stand there",
        ),
    ],
)  # fmt: skip
def test_an_answer_that_does_not_fit_is_told_and_nothing_is_made(
    shell: Shell, lamp: Path, tmp_path: Path, change: dict[str, object], words: str
) -> None:
    hand = tmp_path / "hand"
    hand.mkdir()
    (hand / "pm.md").write_text("1. Plug it in\n")
    (hand / "him.toml").write_text("")
    (hand / "psm.json").write_text(json.dumps(change))
    out = tmp_path / "made" / "lamp.json"
    answer = shell("generate", "text", str(lamp), "-o", str(out), "--by-hand", str(hand))
    assert answer.status == 1
    assert "stage psm does not fit yet" in answer.err
    assert words in answer.err
    assert not out.exists()
    assert (out.parent / "pm.md").exists()


@pytest.mark.parametrize(
    ("page", "line", "words"),
    [
        ("1. Plug it in\n   - whom: nurse\n", 2, "Did you mean who?"),
        ("1. Plug it in\n   - if: It smokes -> Pull [stop]\n", 2, "or the number of a step"),
        ("1. Plug it in\n   - if: It smokes -> Pull [9]\n", 1, "leads back to step 9, and there"),
        ("1. Plug it in\n   - takes: soon\n", 2, "write a time"),
    ],
)
def test_a_line_of_the_page_of_steps_that_says_nothing_is_told(
    shell: Shell, lamp: Path, tmp_path: Path, page: str, line: int, words: str
) -> None:
    hand = tmp_path / "hand"
    hand.mkdir()
    (hand / "pm.md").write_text(page)
    out = str(tmp_path / "made" / "lamp.json")
    answer = shell("generate", "text", str(lamp), "-o", out, "--by-hand", str(hand))
    assert answer.status == 2
    assert answer.err.startswith(f"{hand / 'pm.md'}:{line}:1: ")
    assert words in answer.err


def by_hand(shell: Shell, lamp: Path, out: Path, blueprint: Mapping[str, object]) -> Answer:
    """Answer all stages by hand, with this blueprint, and call the command."""
    hand = out.parent.parent / "hand"
    hand.mkdir(exist_ok=True)
    cite = '   - source: lamp.md, line 3: "Plug it in"\n'
    caution = "\n## Cautions\n\n- Never lick it\n"
    (hand / "pm.md").write_text(f"1. Plug it in\n   - who: nurse\n{cite}{caution}")
    (hand / "him.toml").write_text("")
    (hand / "psm.json").write_text(json.dumps({"LAMP": blueprint}))
    (hand / "rmm").mkdir(exist_ok=True)
    return shell("generate", "text", str(lamp), "-o", str(out), "--by-hand", str(hand))


PLUGGED = {"State_0": {"Op_Plug": "State_1"}, "State_1": {}}


def test_what_a_blueprint_says_otherwise_than_its_steps_is_told(
    shell: Shell, lamp: Path, tmp_path: Path
) -> None:
    out = tmp_path / "made" / "lamp.json"
    notes = {"Op_Plug": {"actor": "human", "roles": ["porter"]}}
    facts = {"0": {"name": "Plugged", "sensors": ["Camera C7"]}}
    answer = by_hand(shell, lamp, out, {**PLUGGED, "_operations": notes, "_facts": facts})
    assert answer.status == 0
    told = [line for line in answer.out.splitlines() if line.startswith("look again: ")]
    assert told == [
        "look again: pm.md names nurse in step 1, and no operation of the blueprint is theirs",
        "look again: LAMP/Op_Plug is for porter, whom pm.md does not name",
        "look again: LAMP/0 is seen by Camera C7, which him.toml does not list",
        "look again: 1 caution stands in pm.md, and no hazard in the blueprint: make one by hand",
    ]


def test_a_wrong_answer_by_hand_is_told_so_that_it_can_be_mended(
    shell: Shell, lamp: Path, tmp_path: Path
) -> None:
    out = tmp_path / "made" / "lamp.json"
    assert by_hand(shell, lamp, out, PLUGGED).status == 0
    misspelt = {**PLUGGED, "_operations": {"Op_Plug": {"requires": {"LAMB/0": "1"}}}}
    answer = by_hand(shell, lamp, out, misspelt)
    assert answer.status == 1
    assert "LAMB/0, which is no fact" in answer.err
    assert "is of an earlier call" in answer.err
    cited = [{"file": "lamp.md", "line": 4, "words": "Plug it in"}]
    answer = by_hand(shell, lamp, out, {**PLUGGED, "_sources": {"Op_Plug": cited}})
    assert "line 4: “Plug it in” (they stand in line 3)" in answer.err
    (tmp_path / "hand" / "psm.json").write_text('{"LAMP": {"State_0": {}')
    folder = str(tmp_path / "hand")
    answer = shell("generate", "text", str(lamp), "-o", str(out), "--by-hand", folder)
    assert "its end seems to be missing" in answer.err


def test_kept_answers_give_the_same_bytes(shell: Shell, lamp: Path, tmp_path: Path) -> None:
    first, second = tmp_path / "a", tmp_path / "b"
    assert shell("generate", "text", str(lamp), "-o", str(first / "lamp.json")).status == 0
    kept = first / "answers.json"
    replay = ("--provider", f"replay:{kept}", "-o", str(second / "lamp.json"))
    assert shell("generate", "text", str(lamp), *replay).status == 0
    for path in first.rglob("*"):
        if path.is_file():
            assert (second / path.relative_to(first)).read_bytes() == path.read_bytes()
    kept.write_text(kept.read_text().replace("Plug it in", "Plug it off", 3))
    answer = shell("generate", "text", str(lamp), *replay)
    assert answer.status == 2
    assert "is not what its digest says" in answer.err


def test_sources_follow_a_new_name_and_a_part_without_one_is_a_warning(
    shell: Shell, lamp: Path, tmp_path: Path
) -> None:
    out = tmp_path / "made" / "lamp.json"
    assert shell("generate", "text", str(lamp), "-o", str(out)).status == 0
    blueprint = smsl.read(out)
    address = next(blueprint["LAMP"].edges()).address
    renamed = editing.rename(blueprint, address, "Op_Other")
    assert [f.rule for f in smsl.inspect(renamed) if f.rule == "R32"] == []
    values = json.loads(out.read_text())
    del values["LAMP"]["_sources"]["State_10"]
    out.write_text(json.dumps(values))
    (finding,) = [f for f in smsl.inspect(smsl.read(out)) if f.rule == "R32"]
    assert (finding.severity.value, str(finding.address)) == ("W", "LAMP/State_10")


REQUIRED = """
properties = [
  {name = "Plugged first", before = ['LAMP/0 = 1', 'LAMP/1 = 1']},
  {name = "Never warm", never = 'LAMP/1 = 1'},
  {name = "Odd", never = 'LAMP/9 = 1'},
]
required = ["Op_Plug*", "LAMP/Op_Switch*", "Op_Gone"]
forbidden = ["Op_Plug", "Op_Skip*"]
sources = ["lamp.md"]
words = ["smokes", "lightning"]
"""


def test_each_requirement_has_a_verdict(shell: Shell, lamp: Path, tmp_path: Path) -> None:
    require, out = tmp_path / "require.toml", tmp_path / "made" / "lamp.json"
    require.write_text(REQUIRED)
    call = ("generate", "text", str(lamp), "-o", str(out), "--require", str(require))
    answer = shell(*call, "--format", "json")
    assert answer.status == 1
    told = [(one["kind"], one["name"], one["verdict"]) for one in answer.json["requirements"]]
    assert told == [
        ("property", "Plugged first", "holds"),
        ("property", "Never warm", "fails"),
        ("property", "Odd", "unknown"),
        ("required", "Op_Plug*", "holds"),
        ("required", "LAMP/Op_Switch*", "holds"),
        ("required", "Op_Gone", "fails"),
        ("forbidden", "Op_Plug", "fails"),
        ("forbidden", "Op_Skip*", "holds"),
        ("sources", "lamp.md", "holds"),
        ("word", "smokes", "fails"),
        ("word", "lightning", "holds"),
    ]
    assert json.loads((out.parent / "requirements.json").read_text()) == answer.json["requirements"]
    require.write_text('words = ["Switch\\u200b  It ON", "\u200b", "Gone it"]\n')
    hidden = shell(*call, "--format", "json").json["requirements"]
    assert [one["verdict"] for one in hidden] == ["fails", "unknown", "holds"]
    none = shell(*call, "--format", "json", "--by-hand", str(tmp_path / "hand")).json
    assert {one["verdict"] for one in none["requirements"]} == {"unknown"}
    assert "no blueprint was made" in (out.parent / "requirements.json").read_text()
    require.write_text('required = ["Op_Plug*"]\n')
    assert shell(*call).status == 0
    require.write_text("required = 3\n")
    assert shell(*call).status == 2


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (("--provider", "reeder"), 2, "Did you mean reader?"),
        (("--provider", "by-hand"), 2, "needs a folder"),
        (("--provider", "replay:gone.json"), 2, "cannot be read"),
        (("--hardware", "gone.md"), 2, "cannot be read"),
        (("--target", "cpp", "--name", "x"), 2, "--name is for code alone"),
    ],
)
def test_wrong_words_are_told(
    shell: Shell, lamp: Path, tmp_path: Path, words: tuple[str, ...], status: int, said: str
) -> None:
    answer = shell("generate", "text", str(lamp), "-o", str(tmp_path / "o" / "x.json"), *words)
    assert answer.status == status
    assert said in answer.err


def test_a_text_in_another_language_is_read_by_its_numbers_and_told(
    shell: Shell, tmp_path: Path
) -> None:
    """What was found is kept; what was not understood is told."""
    texts = {
        "fr.md": "1. L'infirmière lave la plaie.\n2. Si la plaie saigne, appuyez plus fort.\n",
        "zh.md": "1. 用手按压伤口。\n2. 包扎伤口。\n",
        "ar.md": "١. اغسل الجرح\n٢. ضع ضمادة\n",
    }
    for name, text in texts.items():
        with case(name):
            (tmp_path / name).write_text(text)
            made = shell("generate", "text", str(tmp_path / name), "-o", str(tmp_path / "o/x.json"))
            assert made.status == 0
            assert f"look again: {name} is in no language that the reader knows" in made.out
    (tmp_path / "ru.md").write_text("Промойте рану. Затем наложите повязку.\n")
    none = shell("generate", "text", str(tmp_path / "ru.md"), "-o", str(tmp_path / "o/x.json"))
    assert (none.status, "no steps were found" in none.err) == (2, True)


def test_a_text_is_bounded_and_never_written_over(shell: Shell, lamp: Path, tmp_path: Path) -> None:
    huge = tmp_path / "huge.md"
    with huge.open("wb") as file:
        file.truncate(100 << 20)
    answer = shell("generate", "text", str(huge), "-o", str(tmp_path / "o" / "x.json"))
    assert (answer.status, "larger than 4 MB" in answer.err) == (2, True)
    page = lamp.rename(tmp_path / "pm.md")
    answer = shell("generate", "text", str(page), "-o", str(tmp_path / "lamp.json"))
    assert answer.status == 2
    assert page.read_text() == LAMP
