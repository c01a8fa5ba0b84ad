"""Names from files are escaped for each kind of output, by one module."""

from __future__ import annotations

import html
import json
import unicodedata
from xml.etree import ElementTree

import pytest

from smsl_studio.legible import MOST, json_text, markup, one_line, plain_text, whole_text

NAMES = (
    "<img src=x>", "<b>a</b>", "a & b",
    '"quoted"', "\x1b[31mred", "a\u202eb", "a\u200bb", "a\u2066b",
    "a\x00b", "a\nb", "a\tb", "a\x9bb", "\ud800", "a\u2028b", "a\u3164b", "a\ufe0fb", "a\u00adb",
    "\U000e0041", "\ufeffa", "\ufffe",
)  # fmt: skip


def _hides(text: str) -> bool:
    kinds = {unicodedata.category(char) for char in text}
    return bool(kinds & {"Cc", "Cf", "Cs", "Cn", "Zl", "Zp"}) or "\u3164" in text


@pytest.mark.parametrize("name", NAMES)
def test_nothing_hides_steers_or_turns_round(name: str) -> None:
    assert not _hides(one_line(name))
    assert not _hides(plain_text(name).replace("\n", "").replace("\t", ""))
    assert plain_text(plain_text(name)) == plain_text(name)
    element = ElementTree.fromstring(f'<a b="{markup(name)}">{markup(name)}</a>')
    assert element.text == plain_text(name), "markup is read as the text that a label shows"
    assert len(element) == 0
    assert html.unescape(markup(name)) == plain_text(name)
    written = json_text(json.dumps({"name": name}, ensure_ascii=False))
    assert not _hides(written)
    assert json.loads(written) == {"name": name}, "data stays exact"


def test_what_can_be_seen_stays() -> None:
    for name in ("Zürich 中\u00a0\U0001f600", "Op_1b", "a b", "é"):
        assert one_line(name) == plain_text(name) == name
        assert json_text(json.dumps(name, ensure_ascii=False)) == json.dumps(
            name, ensure_ascii=False
        )
    assert one_line("a\nb\x1b[31m\u202ec\r\u2028\x00") == r"a\nb\x1b[31m\u202ec\r\u2028\x00"
    assert plain_text("a\nb\tc\u202e") == "a\nb\tc\\u202e"
    assert markup("<b>\"&'") == "&lt;b&gt;&quot;&amp;'"


@pytest.mark.parametrize("char", ["a", "é", "\u202e", "\U000e0041", "\n"])
def test_what_is_shown_is_cut_and_says_how_much_more_there_is(char: str) -> None:
    whole = char * MOST
    much = plain_text(char * 1_000_000)
    assert len(much) <= MOST == len(plain_text("a" * MOST))
    head, _, tail = much.rpartition("… and ")
    assert tail.endswith(" characters more")
    rest = int(tail.split()[0].replace(",", ""))
    assert whole_text(char * (1_000_000 - rest)) == head
    assert plain_text(much) == much
    assert whole_text(whole * 2) == whole_text(char) * 2 * MOST
    assert len(markup(whole * 2)) >= 2 * MOST, "what is written into a file is never cut"
