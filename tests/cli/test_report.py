"""``report``: the file that is written, what is said about it, and what has changed since."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.people import Desk
from tests.cli.shell import Shell, sample


@pytest.mark.parametrize("form", ["html", "pdf"])
def test_a_report_is_written_and_counted(form: str, shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / f"out.{form}"
    answer = shell("report", sample("registration-people"), "-o", str(out))
    assert answer.status == 0
    assert answer.out.endswith(" lines, 2 of them are open\n")
    assert "8 states have no title or name of their own" in answer.err
    assert out.read_bytes()[:5] in (b"<!DOC", b"%PDF-")


def test_its_json_has_each_line_with_its_key(shell: Shell, tmp_path: Path) -> None:
    out = str(tmp_path / "out.html")
    answer = shell("report", sample("registration-people"), "-o", out, "--format", "json")
    told = json.loads(answer.out)
    sections = {section["key"]: section["lines"] for section in told["sections"]}
    assert list(sections) == ["start", "procedure", "others", "wrong", "hazards", "duties",
                              "watched"]  # fmt: skip
    first = sections["procedure"][0]
    assert (first["mark"], first["heading"], first["who"]) == ("1", "Fix the head", "The nurse")
    assert first["about"] == ["HEAD/State_0/Op_FixHead"]
    keys = [line["key"] for lines in sections.values() for line in lines]
    assert len(set(keys)) == len(keys)


def test_only_html_and_pdf_are_reports(shell: Shell, tmp_path: Path) -> None:
    answer = shell("report", sample("hanoi"), "-o", str(tmp_path / "out.docx"))
    assert (answer.status, answer.out) == (2, "")
    assert "Let it end in .html or .pdf." in answer.err


def test_a_report_never_replaces_its_blueprint(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "own.json"
    file.write_text(Path(sample("hanoi")).read_text())
    link = tmp_path / "out.html"
    link.symlink_to(file)
    before = file.read_bytes()
    assert shell("report", str(file), "-o", str(link)).status == 2
    assert file.read_bytes() == before


def test_against_a_record_it_begins_with_what_has_changed(desk: Desk, tmp_path: Path) -> None:
    assert desk.approve("ada").status == 0
    values = json.loads(Path(desk.file).read_text("utf-8"))
    name = next(one for one in values if not one.startswith("_"))
    state, edges = next((key, one) for key, one in values[name].items() if key[:5] == "State")
    values[name][state] = dict.fromkeys(edges, state)
    desk.write(values)
    out = str(tmp_path / "out.html")
    answer = desk(
        *("report", desk.file, "-o", out, "--against", str(desk.record)), *("--format", "json")
    )
    first, *_ = json.loads(answer.out)["sections"]
    assert first["key"] == "since"
    assert first["lead"].startswith("Compared with the record of Ada Lovelace")
    assert [line["heading"].split(":")[0] for line in first["lines"]] == ["Leads elsewhere"] * len(
        edges
    )


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        ((), "Approved by 1."),
        (("--verdict", "rejected"), "Rejected."),
        (("--condition", "it is dry"), "Approved with conditions."),
    ],
)
def test_a_report_and_a_picture_say_whether_people_have_signed(
    words: tuple[str, ...], wanted: str, desk: Desk
) -> None:
    """As the badge of the window does. What it says comes from the record beside the file."""
    page, picture = desk.folder / "out.html", desk.folder / "out.svg"

    def said() -> tuple[bool, bool]:
        for command, out in (("report", page), ("render", picture)):
            assert desk(command, desk.file, "-o", str(out)).status == 0
        return wanted in page.read_text(), f"{wanted} Not a medical device." in picture.read_text()

    assert said() == (False, False)
    assert "Uninspected." in page.read_text()
    assert "Uninspected. Not a medical device." in picture.read_text()
    assert desk.approve("ada", *words).status == 0
    assert said() == (True, True)
    assert "Ada Lovelace (engineer)" in page.read_text()
