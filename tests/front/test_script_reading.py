"""A script is checked line by line before a run. A fault has its place and an advice."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import ReadError
from smsl_studio.front.script.lines import FAULTS, MOST, read_script, script_of
from smsl_studio.front.script.script import ASKED, AT, DURING, EVERY, WHEN, Script, Trigger
from smsl_studio.front.script.words import WORDS
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.files import parse_text

HANOI = smsl.read(samples_dir() / "hanoi-corrected.json")
EDGE = "SB1/State_aaa/Op_1c"


def _script(*lines: str | dict[str, Any]) -> Script:
    texts = [line if isinstance(line, str) else json.dumps(line) for line in lines]
    return script_of("\n".join(texts).encode(), "s.jsonl", HANOI)


def _fault(*lines: str | dict[str, Any]) -> ReadError:
    with pytest.raises(ReadError) as caught:
        _script(*lines)
    return caught.value


def test_moments_are_at_a_time_at_a_state_or_during_an_operation() -> None:
    script = _script(
        {"at": 1.5, "do": "pause"},
        "",
        {"when": "State_bba", "times": 2, "do": "resume", "_why": "kept for people"},
        {"during": "State_aaa/Op_1c", "after": 0.5, "times": "every", "do": "stop", "by": "Ada"},
        {"do": "answer", "option": "yes"},
        {"do": "step"},
    )
    assert [act.trigger for act in script.acts] == [
        Trigger(AT, 1.5),
        Trigger(WHEN, 0.0, "SB1/State_bba", 2),
        Trigger(DURING, 0.5, EDGE, EVERY),
        Trigger(ASKED),
        Trigger(AT),
    ]
    assert [act.by for act in script.acts] == ["script", "script", "Ada", "script", "script"]
    assert [act.place.line for act in script.acts] == [1, 3, 4, 5, 6]


def test_a_turn_counts_ticks_and_a_line_of_notes_is_left_out() -> None:
    script = _script(
        {"_run": "smsl-studio run hanoi.json --world table", "_by": "a window"},
        {"at": 1, "turn": 2, "do": "pause"},
        {"during": EDGE, "turn": 3, "do": "resume"},
    )
    assert [act.trigger for act in script.acts] == [
        Trigger(AT, 1.0, turn=2),
        Trigger(DURING, 0.0, EDGE, turn=3),
    ]
    for wrong in (0, "every", 1.5, True):
        assert "no count" in _fault({"do": "pause", "turn": wrong}).sentence
    assert "no 'do'" in _fault("{}").sentence
    assert "no 'do'" in _fault({"at": 1, "_why": "nothing"}).sentence


def test_names_may_be_long_and_other_texts_may_not() -> None:
    long = "x" * 9_000
    table = {"SB1": {f"State_{long}": {f"Op_{long}": f"State_{long}"}}}
    blueprint = read_blueprint(parse_text(json.dumps(table), "long.json"))
    edge = f"SB1/State_{long}/Op_{long}"
    lines: list[dict[str, Any]] = [
        {"during": edge, "do": "prune", "address": edge, "reason": "it slipped"},
        {"when": f"SB1/State_{long}", "do": "inject", "fault": "elsewhere", "state": long},
    ]
    raw = "\n".join(map(json.dumps, lines)).encode()
    assert [act.trigger.kind for act in script_of(raw, "s", blueprint).acts] == [DURING, WHEN]
    assert "cannot be printed" in _fault({"do": "pause", "by": long}).sentence


def test_addresses_are_written_out_and_levels_set_apart() -> None:
    script = _script(
        {"do": "prune", "address": "State_aaa/Op_1c", "reason": "grip slipped"},
        {"do": "level", "of": "SB1/Op_1c", "level": "human"},
        {"at": 2, "do": "disturb", "target": "SB1/0", "kind": "stuck", "value": "b"},
        {"at": 2, "do": "inject", "fault": "drop", "disk": 2},
    )
    assert dict(script.acts[0].given) == {"address": EDGE, "reason": "grip slipped"}
    assert script.levels == {"SB1/Op_1c": "human"}
    assert dict(script.acts[1].given) == {"target": "SB1/0", "kind": "stuck", "value": "b"}
    assert dict(script.acts[2].given) == {"fault": "drop", "disk": 2}


def test_the_digest_is_that_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "script.jsonl"
    path.write_bytes(b'\xef\xbb\xbf{"do": "pause"}\r\n')
    script = read_script(path, HANOI)
    assert (script.file, script.digest) == (str(path), sha256_hex(path.read_bytes()))
    assert len(script.acts) == 1
    with pytest.raises(ReadError, match="cannot be read"):
        read_script(tmp_path / "none.jsonl", HANOI)


@pytest.mark.parametrize(
    ("line", "column", "words", "advice"),
    [
        ("{", 2, "no JSON object", ""),
        ("[1]", 1, "no JSON object", ""),
        ('"pause"', 1, "no JSON object", ""),
        ('{"at": 1}', 1, "has no 'do'", "pause"),
        ('{"do": "paus"}', 8, "'paus' is no command", "Did you mean pause?"),
        ('{"do": ["pause"]}', 8, "is no command", "The words are"),
        ('{"do": "pause", "at": -1}', 23, "-1 is no number from 0", ""),
        ('{"do": "pause", "at": NaN}', 23, "NaN is no number", ""),
        ('{"do": "pause", "at": 1e999}', 23, "inf is no number", ""),
        ('{"do": "pause", "at": true}', 23, "True is no number", ""),
        ('{"do": "pause", "at": 1, "at": 2}', 17, "'at' is written twice", "Keep one"),
        ('{"do": "pause", "at": 1, "when": "State_bba"}', 26, "exclude each other", "one moment"),
        ('{"do": "pause", "att": 1}', 17, "pause takes no 'att'", "Did you mean at?"),
        ('{"do": "pause", "after": 1}', 17, "'after' needs a state", ""),
        ('{"do": "pause", "when": "State_xyz"}', 25, "State_xyz", ""),
        ('{"do": "pause", "when": "SB1/State_aaa/Op_1c"}', 25, "is no state", ""),
        ('{"do": "pause", "when": "State_bba", "times": 0}', 47, "0 is no count", ""),
        ('{"do": "pause", "by": ""}', 23, "'' is no text", ""),
        ('{"do": "pause", "by": "\\ud800"}', 23, "cannot be printed", ""),
        ('{"do": "ask"}', 8, "ask needs 'address'", "takes address"),
        ('{"do": "ask", "address": "State_aaa/Op_1d"}', 26, "Op_1d", ""),
        ('{"do": "ask", "address": "State_aaa"}', 26, "stands for 2 operations", ""),
        ('{"do": "full_map", "on": 1}', 26, "neither yes nor no", "true or false"),
        ('{"do": "disturb", "target": "SB2/0", "kind": "stuck"}', 29, "no fact", "SB1"),
        ('{"do": "disturb", "target": "eye", "kind": "stuk"}', 44, "none of", "stuck"),
        ('{"do": "disturb", "target": "eye", "kind": "delay", "rate": 1}', 44, "rate", ""),
        ('{"do": "inject", "fault": "drop", "disk": [1]}', 43, "neither a text", ""),
        ('{"do": "level", "of": "SB1/Op_1c", "level": "humn"}', 45, "no level", "human"),
        ('{"do": "level", "of": "SB9/Op_1c", "level": "human"}', 23, "has no level", ""),
        ('{"do": "level", "of": "SB1/0", "level": "human", "at": 1}', 50, "before the", "Leave"),
        ('{"do": "answer", "option": "yes", "kind": "confrm"}', 43, "none of", "confirm"),
    ],
)
def test_a_wrong_line_is_refused_with_its_place(
    line: str, column: int, words: str, advice: str
) -> None:
    fault = _fault('{"do": "pause"}', line)
    assert str(fault.place) == f"s.jsonl:2:{column}"
    assert words in fault.sentence
    assert advice in fault.advice
    assert fault.advice


def test_all_wrong_lines_are_told_up_to_a_number() -> None:
    assert len(_fault("{", '{"do": "pause"}', "{").faults) == 2
    assert len(_fault(*["{"] * 50).faults) == FAULTS


@pytest.mark.parametrize(
    "raw",
    [
        b"[" * 100_000,
        b'{"do": "pause", "x": ' + b"[" * 60_000,
        b'{"do":' + b"9" * 60_000 + b"}",
        b"\xff\xfe{",
        b'{"do": "' + b"p" * 100_000 + b'"}',
        b"\n" * (MOST + 1),
        b" " * (17 << 20),
    ],
)
def test_hostile_scripts_are_refused(raw: bytes) -> None:
    with pytest.raises(ReadError) as caught:
        script_of(raw, "s.jsonl", HANOI)
    assert caught.value.place is not None


def _is_refused_well(raw: bytes) -> bool:
    try:
        script_of(raw, "s.jsonl", HANOI)
    except ReadError as error:
        return all(one.place is not None for one in error.faults)
    return True


def test_any_changed_script_is_read_or_refused_with_a_place() -> None:
    good = (
        b'{"during": "SB1/State_aaa/Op_1c", "after": 0.5, "times": 2, "do": "disturb",'
        b' "target": "SB1/0", "kind": "noise", "rate": 0.5, "by": "Ada"}'
    )
    random = Random(4)
    for _ in range(2000):
        raw = bytearray(good)
        for _ in range(random.randint(1, 4)):
            at = random.randrange(len(raw))
            raw[at : at + random.randint(0, 3)] = random.randbytes(random.randint(0, 3))
        assert _is_refused_well(bytes(raw))


def test_the_pages_have_every_word_with_what_belongs_to_it() -> None:
    """A command stands in the table of commands, any other word in the list of the scripts."""
    docs = Path(__file__).parents[2] / "docs"
    rows = (docs / "supervision.md").read_text("utf-8").splitlines()
    rows = rows[next(n for n, row in enumerate(rows) if row.startswith("| command | with it |")) :]
    own = (docs / "command-line.md").read_text("utf-8").replace("\n  ", " ").splitlines()
    for word, takes in WORDS.items():
        begin = f"| {takes.row.word} | " if takes.row else f"- `{word}`"
        (line,) = [one for one in (rows if takes.row else own) if one.startswith(begin)]
        assert [key for key in takes.needs if f"`{key}`" not in line] == [], word
        assert [key for key in takes.may if f"`{key}`" not in line] == [], word
        if takes.row and word != takes.row.word:
            assert f"`{word}`" in line


def test_a_parameter_with_the_name_of_a_key_of_the_moment_stands_in_with() -> None:
    opens = {"do": "inject", "fault": "gripper_opens"}
    script = _script(
        {"at": 2, **opens, "seconds": 1, "with": {"after": 0.5}},
        {"during": EDGE, "after": 0.2, **opens, "with": {"after": 0.5, "times": 2}},
    )
    assert [act.given for act in script.acts] == [
        {"fault": "gripper_opens", "seconds": 1, "after": 0.5},
        {"fault": "gripper_opens", "after": 0.5, "times": 2},
    ]
    assert [act.trigger for act in script.acts] == [Trigger(AT, 2.0), Trigger(DURING, 0.2, EDGE)]


@pytest.mark.parametrize(
    ("line", "words", "advice"),
    [
        (
            {"at": 2, "after": 0.5},
            "'after' needs a state or an operation",
            '"with": {"after": 0.5}',
        ),
        ({"with": {"after": [1]}}, "neither a text nor a number", ""),
        ({"with": {}}, "'with' is no object", "Write it like"),
        ({"with": "after"}, "'with' is no object", "Write it like"),
        ({"with": {"a b": 1}}, "inject takes no 'a b'", ""),
        ({"with": {"by": "Ada"}}, "'by' stands in 'with'", ""),
        ({"with": {"fault": "drop"}}, "'fault' stands in 'with'", ""),
        ({"seconds": 1, "with": {"seconds": 1}}, "'seconds' stands in 'with'", ""),
    ],
)
def test_what_does_not_belong_into_with_is_refused(
    line: dict[str, Any], words: str, advice: str
) -> None:
    fault = _fault({"do": "inject", "fault": "gripper_opens", **line})
    assert words in fault.sentence
    assert advice in fault.advice
