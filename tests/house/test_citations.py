"""Every page, section and clause that a docstring, page or test cites exists."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
DOCS = sorted((ROOT / "docs").glob("*.md"))
PAGES = [ROOT / "README.md", *DOCS, *sorted(ROOT.glob("*/README.md"))]
CODE = [
    path
    for folder in ("smsl_studio", "plugins", "benches", "tests")
    for path in sorted((ROOT / folder).rglob("*.py"))
]
CITED = re.compile(r"\b[Cc]lauses?\s+(\d+(?:(?:,|\s+and|\s+to)\s+\d+)*)")


def _sections(page: Path) -> set[str]:
    """The anchors of a page's headings."""
    titles = re.findall(r"^#+ (.+)$", page.read_text("utf-8"), re.MULTILINE)
    bare = (re.sub(r"[^\w\- ]", "", title.lower()) for title in titles)
    return {title.replace(" ", "-") for title in bare}


def test_sections_that_are_pointed_at_are_there() -> None:
    missing = [
        f"{page.name}: {target}#{section}"
        for page in PAGES
        for target, section in re.findall(r"\]\(([^)#:]*)#([^)]+)\)", page.read_text("utf-8"))
        if section not in _sections((page.parent / target) if target else page)
    ]
    assert missing == []


def test_pages_that_the_code_names_are_there() -> None:
    pages = {f"docs/{page.name}" for page in DOCS}
    for path in CODE:
        named = set(re.findall(r"\bdocs/\w[\w-]*\.md\b", path.read_text("utf-8")))
        assert named <= pages, path.relative_to(ROOT)


def test_clauses_that_are_cited_are_on_the_page() -> None:
    page = (ROOT / "docs/running.md").read_text("utf-8")
    clauses = [int(number) for number in re.findall(r"^\| (\d+) \| ", page, re.MULTILINE)]
    assert clauses == list(range(1, len(clauses) + 1))
    cited: dict[int, str] = {}
    for path in [*CODE, *PAGES]:
        for found in CITED.findall(path.read_text("utf-8").replace("\n", " ")):
            for number in re.findall(r"\d+", found):
                cited[int(number)] = str(path.relative_to(ROOT))
    assert {9, 10, 12, 14} <= set(cited)
    assert {number: file for number, file in cited.items() if number not in clauses} == {}


def test_the_readme_names_every_page_once() -> None:
    named = re.findall(r"^\| \[[^]]+\]\((docs/[^)]+)\)", README, re.MULTILINE)
    assert sorted(named) == [f"docs/{page.name}" for page in DOCS]


@pytest.mark.parametrize("start", ["smsl-studio ", "./dev "])
def test_the_readme_shows_no_command_twice(start: str) -> None:
    shown = "\n".join(re.findall(r"^```\n(.*?)^```", README, re.MULTILINE | re.DOTALL))
    lines = (re.sub(r"\s*#.*", "", line) for line in re.split(r"[\n;]", shown))
    commands = [line.strip() for line in lines if line.strip().startswith(start)]
    assert len(commands) > 1
    assert [line for line, count in Counter(commands).items() if count > 1] == []
