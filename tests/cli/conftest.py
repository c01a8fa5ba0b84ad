"""``shell("check", file)`` calls the command line in this process."""

from __future__ import annotations

import pytest

from tests.cli.shell import Shell, make_shell


@pytest.fixture
def shell(capsys: pytest.CaptureFixture[str]) -> Shell:
    return make_shell(capsys)
