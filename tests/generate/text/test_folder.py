"""A folder of texts and PDFs: the best passages are given, cited with file, page and line, and
whatever the folder holds, reading it is bounded."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from smsl_studio.errors import ReadError, UsageError
from smsl_studio.front.generated_text import generate_text
from smsl_studio.generate.text import text_folder
from smsl_studio.generate.text.expert_text import read_text
from smsl_studio.generate.text.passages import PassageIndex
from smsl_studio.generate.text.text_folder import read_folder
from tests.generate.text.test_pdf import page, pdf

LAMP = "# Lamp\n\n1. Plug the lamp in.\n2. Switch the lamp on.\n"
TEA = "# Tea\n\n1. Boil the water.\n2. Pour it on the leaves.\n"
SAFETY = pdf([
    page("Contents"), page("Chapter 2", "Look at the cable of a lamp before you plug it in.")
])  # fmt: skip


@pytest.fixture
def shelf(tmp_path: Path) -> Path:
    """Two procedures, a PDF, one that is broken, an empty file, and one that is no text."""
    folder = tmp_path / "shelf"
    (folder / "old").mkdir(parents=True)
    (folder / "lamp.md").write_text(LAMP)
    (folder / "old" / "tea.md").write_text(TEA)
    (folder / "safety.pdf").write_bytes(SAFETY)
    (folder / "broken.pdf").write_bytes(b"%PDF-1.4\nno")
    (folder / "empty.txt").write_text("")
    (folder / "picture.md").write_bytes(b"\x89PNG\0")
    (folder / ".hidden.md").write_text(TEA)
    (folder / "link.md").symlink_to(folder / "lamp.md")
    return folder


def test_a_folder_gives_its_best_procedure_and_passages_of_others(
    shelf: Path, tmp_path: Path
) -> None:
    read = [text.file for text in read_folder(shelf).texts]
    assert read == ["lamp.md", "safety.pdf", "old/tea.md"]
    made = generate_text([shelf], tmp_path / "made" / "tea.json")
    assert made.is_good
    assert (made.blueprint is not None, made.uncited) == (True, ())
    sources = json.loads((tmp_path / "made" / "tea.json").read_text())["TEA"]["_sources"]
    assert {one["file"] for cited in sources.values() for one in cited} == {"old/tea.md"}
    left_out = {one.partition(":")[0]: one for one in made.left_out}
    assert set(left_out) == {"broken.pdf", "empty.txt", "picture.md"}
    assert "the PDF cannot be read" in left_out["broken.pdf"]
    hand = tmp_path / "hand"
    asked = generate_text([shelf], tmp_path / "lit" / "lamp.json", by_hand=hand)
    assert asked.lacking
    prompt = (hand / "pm.prompt.md").read_text()
    assert "lamp.md 3: 1. Plug the lamp in." in prompt
    assert "safety.pdf page 2 2: Look at the cable of a lamp before you plug it in." in prompt
    assert prompt.index("passages of other texts") > prompt.index("end of expert text")
    words = "Look at the cable of a lamp"
    (hand / "pm.md").write_text(
        f'1. Look at the cable\n   - source: safety.pdf, page 2, line 2: "{words}"\n'
    )
    told = generate_text([shelf], tmp_path / "lit" / "lamp.json", by_hand=hand)
    assert not any("stage pm" in sentence for sentence, _ in told.lacking)
    (hand / "pm.md").write_text(
        f'1. Look at the cable\n   - source: safety.pdf, page 1, line 2: "{words}"\n'
    )
    told = generate_text([shelf], tmp_path / "lit" / "lamp.json", by_hand=hand)
    assert "the words do not stand there: safety.pdf, page 1, line 2" in told.lacking[0][0]


def test_a_named_text_is_the_procedure_and_the_folder_is_searched_for_it(
    shelf: Path, tmp_path: Path
) -> None:
    mine, hand = tmp_path / "mine.md", tmp_path / "hand"
    mine.write_text("1. Plug in the lamp of the microscope.\n2. Focus.\n")
    generate_text([mine, shelf], tmp_path / "made" / "m.json", by_hand=hand)
    prompt = (hand / "pm.prompt.md").read_text()
    expert = prompt[: prompt.index("end of expert text")]
    assert ("mine.md 1:" in expert, "lamp.md 3:" in expert) == (True, False)
    assert "safety.pdf page 2 2:" in prompt


def test_the_same_texts_give_the_same_passages_the_best_first() -> None:
    texts = [read_text(one.encode(), name) for name, one in (("a.md", TEA), ("b.md", LAMP))]
    many = [*texts, *(read_text(b"Nothing of it.\n" * 50, f"c{at}.md") for at in range(20))]
    found = PassageIndex(many).best(["Where is the LAMP plugged in?"])
    assert found[0].text.file == "b.md"
    again = PassageIndex(many).best(["Where is the LAMP plugged in?"])
    assert [(one.lines, one.score) for one in again] == [(one.lines, one.score) for one in found]
    assert PassageIndex(many).best(["zzz", ""]) == []
    assert PassageIndex([read_text(b"-\n", "d.md")]).best(["lamp"]) == []


def test_what_a_folder_may_hold_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for number in range(6):
        (tmp_path / f"{number}.md").write_text(LAMP)
        (tmp_path / f"{number}.pdf").write_bytes(b"%PDF-1.4\nno")
    monkeypatch.setattr(text_folder, "MOST_BAD_PDFS", 1)
    found = read_folder(tmp_path)
    assert len(found.texts) == 6
    assert "too many that cannot be read" in found.left_out[1]
    monkeypatch.setattr(text_folder, "MOST_FILES", 5)
    assert "there are more than 5 texts" in read_folder(tmp_path).left_out[-1]
    monkeypatch.setattr(text_folder, "MOST_CHARACTERS", len(LAMP) * 2)
    assert len(read_folder(tmp_path).texts) == 2
    (tmp_path / "none").mkdir()
    with pytest.raises(ReadError, match="holds no text that can be read"):
        read_folder(tmp_path / "none")


def test_what_is_made_never_lies_in_a_folder_that_is_searched(shelf: Path) -> None:
    with pytest.raises(UsageError, match="which is searched"):
        generate_text([shelf], shelf / "made" / "x.json")
    assert not (shelf / "made").exists()
