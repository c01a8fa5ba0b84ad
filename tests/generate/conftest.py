"""Fixtures for generated code."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from smsl_studio.shipped import resources_dir
from tests.generate.compiler import COMPILER, FLAGS


@pytest.fixture(scope="session")
def engine(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The dispatcher, which is the same for every blueprint, as object files."""
    folder = tmp_path_factory.mktemp("engine")
    sources = sorted((resources_dir() / "code" / "cpp" / "dsfo").glob("*.cpp"))
    objects = [folder / f"{one.stem}.o" for one in sources]
    running = [
        subprocess.Popen([str(COMPILER), *FLAGS, "-c", str(one), "-o", str(made)])
        for one, made in zip(sources, objects, strict=True)
    ]
    assert not any([one.wait() for one in running])  # noqa: C419 (wait for all of them)
    return objects
