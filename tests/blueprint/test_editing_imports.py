"""Edits of ``_imports``: a missing file is refused, and the other entries stay as they are."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.files import read_document


def test_files_are_imported_and_left(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / f"{name}.json").write_text(json.dumps({name: {"S0": {}}}))
    main = tmp_path / "main.json"
    main.write_text('{"_imports": ["gone.json"], "A": {"S0": {}}}')
    before = read_blueprint(read_document(main))
    after = edit.set_imports(before, ["gone.json", "one.json"])
    assert list(after.branches) == ["A", "one"]
    assert len(after.import_faults) == 1, "what led nowhere before still does"
    for files, said in (
        (["gone.json", "one.json", "one.json"], "imported already"),
        (["gone.json", "one.json", "three.json"], "cannot be read"),
        (["gone.json", "one.json", "main.json"], "leads back"),
        (["gone.json", 5], "name of a file"),
    ):
        with pytest.raises(EditRefused, match=said):
            edit.set_imports(after, files)
    assert list(edit.set_imports(after, []).branches) == ["A"]
    odd = tmp_path / "odd.json"
    odd.write_text('{"_imports": 3}')
    with pytest.raises(EditRefused, match="no list"):
        edit.set_imports(read_blueprint(read_document(odd)), ["one.json"])
