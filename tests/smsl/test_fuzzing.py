"""For any bytes in a file, the readers answer with a place, without traceback, in linear work."""

from __future__ import annotations

import sys
from collections.abc import Callable

import pytest

from smsl_studio.errors import ReadError
from smsl_studio.smsl.forms import form_named
from tests.counts import share_of
from tests.smsl.fuzzing import OPENERS, TOKENS, files, look

FILES = share_of(2000)
PARTS = max(1, FILES // 250)


@pytest.mark.parametrize("part", range(PARTS))
def test_every_broken_file_gets_an_answer(part: int) -> None:
    opened = 0
    for raw, file in files(part, FILES // PARTS):
        opened += look(raw, file).accepted
    assert 0 < opened < FILES // PARTS, "some open and some do not, or nothing was tried"


FOUND = [("00:[{#\n0][]}", "json")]
"""What once was answered by a traceback, as short as it gets."""


@pytest.mark.parametrize(("text", "form"), FOUND)
def test_what_was_found_stays_found(text: str, form: str) -> None:
    doors = form_named(form)
    with pytest.raises(ReadError):
        doors.parse(text, "x")
    assert doors.recover(text, "x").form == form


def calls(work: Callable[[], object]) -> int:
    """How many calls a piece of work makes: the same on every machine and day."""
    count = 0

    def one_more(_frame: object, event: str, _argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(one_more)
    try:
        work()
    finally:
        sys.setprofile(None)
    return count


HEADS = {
    "json": ('{"A": {"S": {', '"x": ', "{"),
    "smsl": ("{ # NAME: A\n", "S: [", "# _x: ", ""),
    "yaml": ("A:\n  S: ", "A: [S: [", "_x: "),
}


def _tried(form: str, text: str) -> Callable[[], object]:
    doors = form_named(form)

    def read() -> None:
        try:
            doors.parse(text, "x")
        except ReadError:
            doors.recover(text, "x")

    return read


@pytest.mark.parametrize("form", list(HEADS))
def test_twice_the_text_is_no_more_than_twice_the_work(form: str) -> None:
    _tried(form, "")()
    for head in HEADS[form]:
        for piece in [*OPENERS, *TOKENS, '"a": "b", ', "a -> b ", "a: b\n", "[a: b], "]:
            times = max(2, 200 // len(piece))
            once = calls(_tried(form, head + piece * times))
            twice = calls(_tried(form, head + piece * (2 * times)))
            assert twice <= 2.6 * once + 600, (head, piece, once, twice)
