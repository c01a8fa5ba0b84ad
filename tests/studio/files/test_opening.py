"""Opening a file in the window."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.smsl.together import save_together
from smsl_studio.studio.files.opening import open_file


def test_opening_brings_a_save_to_its_end_that_was_left_unfinished(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    base, sub = tmp_path / "base.json", tmp_path / "sub.json"
    base.write_text('{"_imports": ["sub.json"], "A": {}}')
    sub.write_text('{"B": {}}')
    replace = os.replace

    def dies(source: Any, target: Any) -> None:
        if os.fspath(target) == str(sub):
            raise KeyboardInterrupt
        replace(source, target)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", dies)
        with pytest.raises(KeyboardInterrupt):
            save_together([(base.read_text().replace("A", "A2"), base), ('{"B2": {}}', sub)])
    assert sub.read_text() == '{"B": {}}'
    assert list(open_file(base).blueprint.branches) == ["A2", "B2"]
    assert sub.read_text() == '{"B2": {}}'
    assert sorted(path.name for path in tmp_path.iterdir()) == ["base.json", "sub.json"]
