"""Makes the files of a save whose process has died in the middle."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from tests.smsl.killed import TEXTS, save


def left_unfinished(files: list[Path], monkeypatch: pytest.MonkeyPatch) -> None:
    """A save whose process died when one file had its new bytes and the others not."""
    replace = os.replace
    done: list[Any] = []

    def dies(source: Any, target: Any) -> None:
        if os.fspath(target).endswith(".json"):
            if done:
                raise KeyboardInterrupt
            done.append(target)
        replace(source, target)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", dies)
        with pytest.raises(KeyboardInterrupt):
            save(files, "b")
    assert {path.read_text("utf-8") for path in files} == set(TEXTS.values())
