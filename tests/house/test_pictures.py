"""The pictures in the repository are few and small, and each is shown on a page. One that is drawn
is the one that ``render`` draws now."""

from __future__ import annotations

from pathlib import Path

from smsl_studio import read
from smsl_studio.front.outputs import drawn

ROOT = Path(__file__).resolve().parents[2]
MOST, LARGEST = 14, 150_000
"""So many pictures at most, of so many bytes; ``./dev pictures`` makes all others."""


def test_few_small_pictures_are_kept_and_each_is_shown() -> None:
    pictures = sorted((ROOT / "docs" / "images").iterdir())
    assert 0 < sum(picture.suffix == ".png" for picture in pictures) <= MOST
    texts = [
        path.read_text("utf-8") for path in (ROOT / "README.md", *(ROOT / "docs").glob("*.md"))
    ]
    for picture in pictures:
        assert picture.stat().st_size < LARGEST, picture.name
        assert any(f"images/{picture.name}" in text for text in texts), picture.name


def test_the_map_of_branches_is_the_one_that_render_draws() -> None:
    kept = ROOT / "docs" / "images" / "three-levels-map.svg"
    made = drawn(read(ROOT / "samples" / "three-levels.json"), kept, overview=True)
    assert kept.read_bytes() == made, "write it anew with render --map"
