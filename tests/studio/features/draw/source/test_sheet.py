"""Typing into the shown text changes the exact text there and nowhere else."""

from __future__ import annotations

from hypothesis import example, given, settings
from hypothesis import strategies as st

from smsl_studio.studio.features.draw.source.patches import patches
from smsl_studio.studio.features.draw.source.sheet import LONG, TextSheet
from smsl_studio.studio.features.draw.source.shown_text import from_units, shown, units
from tests.counts import share_of

EXACT = st.lists(
    st.sampled_from(["a", '"', "{", "\n", "\r\n", "\r", "\u2028", "é", "𝛼", "\ufeff", "\x85"]),
    max_size=30,
).map("".join)
TYPED = st.text(st.sampled_from('ab\n"é𝛼'), max_size=6)


@st.composite
def typing(draw: st.DrawFn) -> tuple[str, int, int, str]:
    """A text, what is marked in what is shown of it, and what is typed over that."""
    text = draw(st.sampled_from(["", "\ufeff"])) + draw(EXACT)
    length = len(TextSheet(text).shown)
    start = draw(st.integers(0, length))
    return text, start, draw(st.integers(start, min(length, start + 5))), draw(TYPED)


def type_into(sheet: TextSheet, start: int, end: int, words: str) -> bool:
    """What the editor tells the sheet when words replace a part of what is shown."""
    before = sheet.shown
    after = before[:start] + words + before[end:]
    first = before.count("\n", 0, start)
    last = before.count("\n", 0, end)
    grown = words.count("\n") - before.count("\n", start, end)
    lines = after.split("\n")[first : last + 1 + grown]
    return sheet.typed(first, last, lines, start - (before.rfind("\n", 0, start) + 1))


@settings(max_examples=share_of(300))
@given(typing())
@example(("a\ufeff", 0, 1, ""))
def test_what_is_shown_is_what_was_typed(case: tuple[str, int, int, str]) -> None:
    text, start, end, words = case
    sheet = TextSheet(text)
    before = sheet.shown
    changed = type_into(sheet, start, end, words)
    assert changed == (sheet.text != text)
    assert sheet.shown == before[:start] + words + before[end:]
    assert sheet.shown == TextSheet(sheet.text).shown


@settings(max_examples=share_of(300))
@given(typing())
def test_what_was_not_touched_keeps_its_spelling(case: tuple[str, int, int, str]) -> None:
    text, start, end, words = case
    sheet = TextSheet(text)
    before = sheet.shown
    at = [sheet.offset(before.count("\n", 0, point), point - before.rfind("\n", 0, point) - 1)
          for point in (start, end)]  # fmt: skip
    head, tail = text[: at[0]], text[at[1] :]
    type_into(sheet, start, end, words)
    # A lone CR before a typed line end is kept apart from it by one more character.
    assert sheet.text.startswith(head.removesuffix("\r"))
    assert sheet.text.endswith(tail) or "\r" in text


@settings(max_examples=share_of(200))
@given(EXACT, EXACT)
def test_a_patched_sheet_is_that_of_the_new_text(old: str, new: str) -> None:
    sheet, lines = TextSheet(old), TextSheet(old).shown.split("\n")
    for start, end, part in patches(old, new):
        first, gone, come = sheet.put(start, end, part)
        assert lines[first : first + len(gone)] == gone
        lines[first : first + len(gone)] = come
    assert sheet.text == new
    assert "\n".join(lines) == sheet.shown == TextSheet(new).shown


@given(EXACT)
def test_every_offset_is_shown_somewhere_and_leads_back(text: str) -> None:
    sheet = TextSheet(text)
    for at, line in enumerate(sheet.shown.split("\n")):
        for column in range(len(line) + 1):
            assert sheet.where(sheet.offset(at, column)) == (at, column)
    last = len(sheet.pieces) - 1
    assert sheet.where(len(text)) == (last, len(sheet.shown_piece(last)))


@given(st.text(st.sampled_from("aé𝛼\u2028"), max_size=9))
def test_qt_counts_in_units(text: str) -> None:
    for at in range(len(text) + 1):
        assert from_units(text, units(text[:at])) == at


def test_a_line_end_that_is_typed_is_that_of_the_file() -> None:
    sheet = TextSheet('{\r\n "a": {}\r\n}\r\n')
    type_into(sheet, 1, 1, "\n x")
    assert sheet.text == '{\r\n x\r\n "a": {}\r\n}\r\n'


def test_a_very_long_line_is_shown_in_pieces_and_stays_one_line() -> None:
    text = "{" + '"State_0": {"Op": "State_1"}, ' * 2000 + "}\n// end"
    sheet = TextSheet(text)
    assert max(map(len, sheet.pieces)) <= LONG
    assert sheet.text == text
    middle = len(sheet.pieces) // 2
    assert sheet.line_of(middle) == 0
    assert not sheet.begins_line(middle)
    last = len(sheet.pieces) - 1
    assert (sheet.line_of(last), sheet.piece_of(1)) == (1, last)
    piece = sheet.shown_piece(middle)
    sheet.typed(middle, middle, [piece[:5] + "x", "y" + piece[5:]], 5)
    at = text.index(piece, sum(map(len, sheet.pieces[:middle]))) + 5
    assert sheet.text == text[:at] + "x\ny" + text[at:]


def test_joining_the_pieces_of_a_long_line_changes_nothing() -> None:
    sheet = TextSheet("ab, " * 4000)
    one, two = sheet.shown_lines(0, 1)
    text = sheet.text
    sheet.typed(0, 1, [one + two], len(one))
    assert sheet.text == text


def test_stand_ins_are_one_character_each() -> None:
    assert shown("\ufeffa\u2028b\rc\r\n", first=True) == "a\ufffdb\u240dc\n"
    assert shown("\ufeffa") == "\ufeffa"
