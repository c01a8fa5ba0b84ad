"""The JSON Schema in resources/ matches the model, and agrees with the reader."""

from __future__ import annotations

import json
from copy import deepcopy
from dataclasses import fields
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.schema import DIALECT, NOTES, WORDS, schema_text
from smsl_studio.errors import ReadError
from smsl_studio.smsl.json_form import parse_json

ROOT = Path(__file__).parents[2]
SCHEMA = json.loads((ROOT / "resources" / "smsl.schema.json").read_text(encoding="utf-8"))
SAMPLES = sorted((ROOT / "samples").glob("*.json"))
VALIDATOR = Draft202012Validator(SCHEMA)

GOOD: dict[str, Any] = {
    "_imports": ["other.json"],
    "_hazards": [{"name": "burn", "facts": {"SB/0": "1", "SB2/0": "0"}}],
    "_levels": {"supervision": "human", "SB/0": "shared", "SB/S0/o": "human"},
    "SB": {
        "HEADER": {"INITIAL": "S0", "NUM_FACTS": 1, "SUB_SBS": [{"SB2": 0}], "OTHER": [1]},
        "_facts": {"0": {"name": "tool", "sensors": ["s"], "aggregation": "k_of_n", "k": 2}},
        "_states": {"S0": {"title": "Start", "safe": True}},
        "_operations": {
            "o": {"cost": 2.5, "binding": {"function": "p.f"}},
            "S0/o": {"risk": "low"},
        },
        "_layout": {"S0": [1, 2.5]},
        "_anything": None,
        "S0": {"o": "S1", "_note": 5},
        "S1": {},
    },
    "SB2": {"HEADER": {"SUB_SBS": None, "ACTIVATING": None}},
}


def changed(path: str, value: Any) -> dict[str, Any]:
    """The good file with another value at a path of keys."""
    file = deepcopy(GOOD)
    *above, last = path.split(" ")
    inner: Any = file
    for key in above:
        inner = inner[int(key) if isinstance(inner, list) else key]
    inner[last] = value
    return file


def test_the_file_is_in_step_with_the_model() -> None:
    written = (ROOT / "resources" / "smsl.schema.json").read_text(encoding="utf-8")
    assert written == schema_text(), "run .venv/bin/python packaging/schema.py"


def test_it_is_a_schema_of_its_dialect() -> None:
    assert SCHEMA["$schema"] == DIALECT
    Draft202012Validator.check_schema(SCHEMA)


def test_an_editor_has_something_to_say_of_every_word() -> None:
    for note in NOTES:
        assert set(WORDS[note.__name__]) == {"", *(one.name for one in fields(note))}
    header = SCHEMA["$defs"]["Header"]["properties"]
    assert list(header) == ["INITIAL", "ACTIVATING", "NUM_FACTS", "NUM_STATES", "SUB_SBS"]
    assert all(one["description"] for one in header.values())


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.name)
def test_every_sample_is_valid(path: Path) -> None:
    VALIDATOR.validate(json.loads(path.read_bytes()))


def test_annotations_of_every_kind_are_valid() -> None:
    VALIDATOR.validate(GOOD)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("version", 1),
        ("SB", []),
        ("", {}),
        ("SB HEADER", "x"),
        ("SB S1", "S0"),
        ("SB ", {}),
        ("SB S0 o", 5),
        ("SB S0 ", "S1"),
    ],
)
def test_what_cannot_be_opened_is_not_valid(path: str, value: Any) -> None:
    file = changed(path, value)
    with pytest.raises(ReadError):
        read_blueprint(parse_json(json.dumps(file), "f.json"))
    assert not VALIDATOR.is_valid(file)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("SB HEADER INITIAL", 5),
        ("SB HEADER NUM_FACTS", "3"),
        ("SB HEADER NUM_FACTS", 0),
        ("SB HEADER SUB_SBS", {"SB2": "x"}),
        ("SB HEADER SUB_SBS", ["SB2"]),
        ("SB _facts x", {}),
        ("SB _facts 0 agregation", "all"),
        ("SB _facts 0 aggregation", "some"),
        ("SB _states S0 safe", "perhaps"),
        ("SB _operations o cost", -1),
        ("SB _operations o binding", {"arguments": {}}),
        ("SB _layout S0", [1]),
        ("_hazards", [{"facts": {}}]),
        ("_imports", "other.json"),
    ],
)
def test_what_inspection_finds_of_the_wrong_kind_is_not_valid(path: str, value: Any) -> None:
    assert not VALIDATOR.is_valid(changed(path, value))
