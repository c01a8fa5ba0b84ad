"""The pages of a report: hostile names stay text, nothing is loaded, and a PDF has its tags."""

from __future__ import annotations

import io
import json
from collections.abc import Sequence
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
from pypdf import PdfReader

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.readings import reading
from smsl_studio.front.reports import report
from smsl_studio.inspection.reading.reading_page import Illustration, reading_page
from smsl_studio.inspection.reading.reading_sheet import reading_sheet
from smsl_studio.inspection.reading.sections import BlueprintReading
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.json_form import parse_json

DAY = "2026-11-26"
HOSTILE = (
    "<script>alert(1)</script><img src=http://a.b/c onerror=x()>",
    '#import "x"; *b* $x$ \\ #read("/etc/passwd")',
    "\u202eright to left\u200b",
    "x" * 10_000,
    "é漢字😀",
)


def sample(name: str) -> Blueprint:
    return read_blueprint(read_document(samples_dir() / name))


def hostile(number: int) -> BlueprintReading:
    """A reading in which one hostile text is every title, name, question and role."""
    text = HOSTILE[number]
    note = {"title": text, "question": text, "roles": [text], "actor": "human"}
    fact = {"name": text, "values": {"0": text, "1": text}, "sensors": [text], "failure": ["1"]}
    values = {
        "_hazards": [{"name": text, "facts": {"A/0": "1"}}],
        "A": {
            "_facts": {"0": fact},
            "_states": {"State_0": {"title": text}, "State_1": {"title": text}},
            "_operations": {"Op_up": note, "Op_down": note},
            "State_0": {"Op_up": "State_1"},
            "State_1": {"Op_down": "State_0"},
        },
    }
    return reading(read_blueprint(parse_json(json.dumps(values), "a.json")), "engineer")


class Seen(HTMLParser):
    """The elements and links of a page, and its text."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.links: list[str] = []
        self.handlers: list[str] = []
        self.text = ""
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.links += [value or "" for name, value in attrs if name in ("href", "src", "action")]
        self.handlers += [name for name, _ in attrs if name.startswith("on")]

    def handle_data(self, data: str) -> None:
        self.text += data


@pytest.mark.parametrize("number", range(len(HOSTILE)))
def test_a_hostile_name_is_text_in_both_pages(number: int) -> None:
    told = hostile(number)
    seen = Seen(reading_page(told, DAY))
    assert not seen.tags & {"script", "img", "iframe", "object", "link", "form", "base"}
    assert not seen.handlers
    assert all(link.startswith("#") for link in seen.links)
    assert "\u202e" not in seen.text
    if number != 2:
        assert HOSTILE[number] in seen.text
    pages = PdfReader(io.BytesIO(reading_sheet(told, DAY))).pages
    words = "".join(page.extract_text() for page in pages)
    assert ("alert(1)", "#import", "right to left", "xxxxxxxxxx", "é")[number] in words


def test_a_page_asks_for_nothing_and_has_each_line_of_the_reading() -> None:
    told = reading(sample("registration-people.json"))
    page = reading_page(told, DAY, [Illustration("HEAD", "<svg></svg>")])
    seen = Seen(page)
    assert "default-src 'none'" in page
    for section, line in told.lines():
        assert f"#{section.key}" in seen.links
        assert all(words in seen.text for words in line.words)
    assert seen.text.count("Not a medical device") == 2
    assert seen.text.count("if every operation does what its edge says") == 1
    assert page == reading_page(told, DAY, [Illustration("HEAD", "<svg></svg>")])


def test_a_pdf_has_a_title_an_outline_tags_and_its_standards(tmp_path: Path) -> None:
    told = report(sample("registration-drilling.json"), tmp_path / "drilling.pdf")
    file = PdfReader(tmp_path / "drilling.pdf")
    root: Any = file.trailer["/Root"]
    assert root["/MarkInfo"]["/Marked"].value is True
    assert "/StructTreeRoot" in root
    assert root["/Lang"] == "en"
    metadata = root["/Metadata"].get_data().decode("utf-8")
    assert "<pdfaid:part>2</pdfaid:part>" in metadata
    assert "<pdfaid:conformance>A</pdfaid:conformance>" in metadata
    assert "<pdfuaid:part>1</pdfuaid:part>" in metadata
    assert file.metadata is not None
    assert file.metadata.title == told.title
    titles = [str(one.title) for one in _flat(file.outline)]
    assert [section.heading for section in told.sections] == [
        title for title in titles if title in {section.heading for section in told.sections}
    ]
    words = [page.extract_text() for page in file.pages]
    assert all("Not a medical device" in one for one in words)
    assert all(f"{at} of {len(words)}" in one for at, one in enumerate(words, 1))
    assert all(told.digest[:16] in one for one in words)


def _flat(outline: Sequence[Any]) -> list[Any]:
    found: list[Any] = []
    for one in outline:
        found += _flat(one) if isinstance(one, list) else [one]
    return found


def test_only_for_an_engineer_the_names_of_the_file_are_told() -> None:
    blueprint = sample("registration-people.json")
    plain, whole = (
        " ".join(words for _, line in reading(blueprint, reader).lines() for words in line.words)
        for reader in ("clinician", "engineer")
    )
    assert "Op_" not in plain
    assert "State_" not in plain
    assert "Fix the head [Op_FixHead]" in whole


def test_a_high_picture_stands_whole_below_its_heading(tmp_path: Path) -> None:
    """The map of the parts is higher than a page is wide."""
    out = tmp_path / "femoroplasty.pdf"
    report(sample("femoroplasty.json"), out)
    pages = PdfReader(out).pages
    (first,) = [page for page in pages if "How the parts of the procedure" in page.extract_text()][
        -1:
    ]
    texts = first.extract_text()
    assert all(part in texts for part in ("LEG", "TRACKER", "INJECTION"))


def test_a_fact_that_people_say_tells_who_answers_and_how_long() -> None:
    told = reading(sample("femoroplasty.json"))
    watched = next(one for one in told.sections if one.key == "watched")
    markers = next(one for one in watched.lines if one.heading == "Markers on the bone")
    assert markers.text[-2:] == (
        "It is answered by the surgeon.",
        "The answer must come within 2 minutes; after half of that time the nurse may answer too."
        " Without an answer the fact is not known.",
    )


def test_a_step_that_takes_a_sub_procedure_back_says_to_where() -> None:
    told = reading(sample("femoroplasty.json"))
    others = next(one for one in told.sections if one.key == "others")
    back = next(
        one for one in others.lines if one.heading == "Discard the match of patient and scan"
    )
    assert "Its sub-procedure goes back to its beginning: “No markers”." in back.text
