"""The examples in the docstrings of the front door are run, and give the shown results.

They are run in a folder with the samples, their scripts and a log ``run.jsonl``.
"""

from __future__ import annotations

import doctest
import shutil
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.shipped import samples_dir

NAMES = sorted({*smsl.__all__, *front.__all__})


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of its own, with what the examples read."""
    for path in (*samples_dir().glob("*.json"), *samples_dir().glob("scripts/*.jsonl")):
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    smsl.run(smsl.read("hanoi-2.json"), goal="State_cc", log=Path("run.jsonl"), host="local")
    return tmp_path


@pytest.mark.parametrize("name", NAMES)
def test_the_example_of_a_verb_says_what_comes_out(name: str, folder: Path) -> None:
    known = {one: getattr(front, one) for one in front.__all__}
    found = doctest.DocTestFinder(recurse=False).find(
        getattr(front, name), name, globs={**known, "Address": Address, "Path": Path}
    )
    assert found, f"{name} shows no example"
    said: list[str] = []
    tests = doctest.DocTestRunner()
    for example in found:
        assert example.examples, f"{name} shows no example"
        tests.run(example, out=said.append)
    assert not said, "".join(said)


def test_the_package_offers_what_the_front_offers() -> None:
    assert set(smsl.__all__) <= set(front.__all__)
