"""Places in a text: line and column of everything in it, whatever ends its lines."""

from __future__ import annotations

import random
import re

import pytest

from smsl_studio.smsl.document import Document, Member
from smsl_studio.smsl.forms import form_named
from tests.smsl.native_texts import native, plain
from tests.smsl.texts import written

VALUES = {
    "SB": {
        "HEADER": {"INITIAL": "S1", "NUM_FACTS": 1},
        **{f"S{n}": {f"Op_{m}": f"S{m}" for m in range(4)} for n in range(120)},
        "_layout": {f"S{n}": [n, 0.5] for n in range(120)},
    },
    "_hazards": [{"name": "h", "facts": {"SB/0": "1"}}],
}


def documents() -> list[Document]:
    """The same in every form, several blocks of a text long."""
    texts = {"json": written(VALUES, 7), "smsl": native(plain(VALUES), 7)}
    texts["yaml"] = form_named("yaml").write(VALUES)
    return [form_named(form).parse(text, f"f.{form}") for form, text in texts.items()]


def counted_out(text: str, offset: int) -> tuple[int, int]:
    """Line and column as somebody finds them who reads from the beginning."""
    ends = [0, *(end.end() for end in re.finditer("\r\n?|\n", text))]
    line = max(at for at, begins in enumerate(ends) if begins <= offset)
    return line + 1, offset - ends[line] + 1


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_line_and_column_are_those_somebody_counts(end: str) -> None:
    chance = random.Random(3)
    for document in documents():
        text = re.sub("\r\n?|\n", end, document.text)
        ended = Document(text, "f", document.form, {}, document.spans_of)
        for _ in range(40):
            offset = chance.randrange(len(text) + 1)
            place = ended.place_at(offset)
            assert (place.line, place.column) == counted_out(text, offset)


def test_a_text_may_end_its_lines_in_every_way_at_once() -> None:
    text = ("a\rb\r\nc\n\r\n\rd" * 400) + "\n"
    document = Document(text, "f", "json", {}, form_named("json").parse("{}", "").spans_of)
    for offset in range(0, len(text) + 1, 7):
        place = document.place_at(offset)
        assert (place.line, place.column) == counted_out(text, offset)


def test_each_member_is_the_one_that_is_listed() -> None:
    for document in documents():
        for path in ((), ("SB",), ("SB", "HEADER"), ("SB", "S7"), ("SB", "_layout")):
            listed: dict[str, Member] = {one.key: one for one in document.members(path)}
            assert {key: document.member((*path, key)) for key in listed} == listed
            with pytest.raises(KeyError):
                document.member((*path, "nothing"))
        with pytest.raises(KeyError):
            document.member(("SB", "HEADER", "INITIAL", "below a text"))
