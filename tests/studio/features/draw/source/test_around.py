"""What lies around a caret, also in half-typed text, in all three forms."""

from __future__ import annotations

import pytest

from smsl_studio.studio.features.draw.source.around import Around, around, key_at, path_at, unquoted

JSON = """{
    "SB1": {
        "HEADER": {"INITIAL": "State_0", "SUB_SBS": {"SB2": 1}},
        "State_0": {
            "Op": "State_1",
            "Op_2": "St|
        }
    },
    "SB2": {
        "HEADER":
        {
            "ACTIVATING": |
        },
        |
"""
NATIVE = """// { [ "SB1": {
{
    # NAME: SB1
    # INITIAL: St|
    # SUB_SBS: (SB2: 1)
    State_0: [Op -> State_1],
    State_1: [
        a-b -> St|
        Op|
    ],
    St|
}
"""
BLOCK = """SB1:
  HEADER:
    INITIAL: |
  State_0:
    Op: State_1
    Op_2: St|
  # State_9:
  State_1: {Op: |}
SB2:
  |
"""
LISTS = """SB1: [
    HEADER: [INITIAL: State_0],
    State_0: [
        Op: St|
    ],
    |
"""


def at_bars(text: str, form: str) -> list[Around]:
    """What stands around each bar, which itself is not there."""
    found = []
    lines = [line + "\n" for line in text.split("\n")]
    for number, line in enumerate(lines):
        if "|" in line:
            clean = [one.replace("|", "") for one in lines]
            found.append(around(clean, number, line.index("|"), form))
    return found


def brief(found: list[Around]) -> list[tuple[tuple[str, ...], str, str]]:
    return [(one.path, one.key, one.word) for one in found]


def test_json() -> None:
    assert brief(at_bars(JSON, "json")) == [
        (("SB1", "State_0"), "Op_2", "St"),
        (("SB2", "HEADER"), "ACTIVATING", ""),
        (("SB2",), "", ""),
    ]


def test_native() -> None:
    assert brief(at_bars(NATIVE, "smsl")) == [
        (("SB1", "HEADER"), "INITIAL", "St"),
        (("SB1", "State_1"), "a-b", "St"),
        (("SB1", "State_1"), "", "Op"),
        (("SB1",), "", "St"),
    ]


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (
            BLOCK,
            [
                (("SB1", "HEADER"), "INITIAL", ""),
                (("SB1", "State_0"), "Op_2", "St"),
                (("SB1", "State_1"), "Op", ""),
                (("SB2",), "", ""),
            ],
        ),
        (LISTS, [(("SB1", "State_0"), "Op", "St"), (("SB1",), "", "")]),
    ],
)
def test_yaml(text: str, wanted: list[tuple[tuple[str, ...], str, str]]) -> None:
    assert brief(at_bars(text, "yaml")) == wanted


def test_the_name_that_a_value_belongs_to() -> None:
    line = '        "Op_1": "State_1", "Op_2": "State_2"'
    name = key_at(line, line.index("State_2"), "json")
    assert name is not None
    assert (name.name, name.start) == ("Op_2", line.index('"Op_2'))
    assert key_at(line, 2, "json") is None


def test_names_in_quotes_of_every_kind() -> None:
    assert [unquoted(word) for word in ('"a\\"b"', '"half', "'it''s'", "bare", '"')] == [
        'a"b', "half", "it's", "bare", "",
    ]  # fmt: skip


def test_a_place_is_found_quickly_in_a_megabyte() -> None:
    state = '  "State_%d": {\n    "Op": "State_0"\n  },\n'
    lines = ("{\n " + "".join(state % at for at in range(20_000))).splitlines(keepends=True)
    lines.insert(1, ' "SB1": {\n')
    assert path_at(lines, len(lines) - 2, 5, "json") == ("SB1", "State_19999")
