"""The pictures in the repository are few and small, and each is shown on a page."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MOST, LARGEST = 12, 150_000
"""So many pictures at most, of so many bytes; ``./dev pictures`` makes all others."""


def test_few_small_pictures_are_kept_and_each_is_shown() -> None:
    pictures = sorted((ROOT / "docs" / "images").iterdir())
    assert 0 < len(pictures) <= MOST
    texts = [
        path.read_text("utf-8") for path in (ROOT / "README.md", *(ROOT / "docs").glob("*.md"))
    ]
    for picture in pictures:
        assert picture.stat().st_size < LARGEST, picture.name
        assert any(f"images/{picture.name}" in text for text in texts), picture.name
