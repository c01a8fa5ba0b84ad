"""Fixtures for generated code."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.generate.built_programs import compiled_engine


@pytest.fixture(scope="session")
def engine(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The dispatcher, which is the same for every blueprint, as object files."""
    folder = tmp_path_factory.mktemp("engine")
    return compiled_engine(folder)
