"""What the start page says about trust in a file that nobody has signed."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.front.generated import generate_rules
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.files import save_document
from smsl_studio.studio.features.start.thumbnails import trust_at


def words(path: Path) -> str:
    found = trust_at(path, None)
    assert found is not None
    return found.words


def test_a_computed_file_is_told_apart_from_a_drawn_one(tmp_path: Path) -> None:
    made, broken = tmp_path / "river.json", tmp_path / "broken.json"
    save_document(generate_rules(samples_dir() / "rules" / "river.toml").blueprint.document, made)
    broken.write_text("{", "utf-8")
    assert words(made) == "Generated, not inspected"
    assert words(samples_dir() / "hanoi.json") == "Uninspected"
    assert words(broken) == "Uninspected"
