"""``shell("check", file)`` calls the command line in this process; ``desk`` has keys."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.people import Desk, make_desk
from tests.cli.shell import Shell, make_shell


@pytest.fixture
def shell(capsys: pytest.CaptureFixture[str]) -> Shell:
    return make_shell(capsys)


@pytest.fixture
def desk(shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Desk:
    return make_desk(shell, tmp_path, monkeypatch)
