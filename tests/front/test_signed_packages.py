"""Signed code of an installed package is what runs, however Python would find its modules."""

from __future__ import annotations

import json
import os
import py_compile
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.runlog.events import RunFinished
from tests.approval import PASSPHRASE, make_keys_cheap
from tests.installed_package import BLUEPRINT, EVIL, write_package

WORDS = PASSPHRASE.encode()


@pytest.fixture(autouse=True)
def _nothing_stays() -> Iterator[None]:
    """Remove what a run in this process leaves of a package."""
    before = list(sys.meta_path)
    yield
    sys.meta_path[:] = before
    for name in [one for one in sys.modules if one.partition(".")[0] in ("lamp_pack", "lamp_more")]:
        del sys.modules[name]


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A blueprint with a key that can approve it."""
    make_keys_cheap(monkeypatch)
    path = tmp_path / "lamp.json"
    path.write_text(json.dumps(BLUEPRINT), "utf-8")
    smsl.make_key("Ada Lovelace", "engineer", WORDS, "ada")
    return path


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = write_package(tmp_path / "site")
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    return folder


@pytest.fixture
def editable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = write_package(tmp_path / "site", tmp_path / "src")
    monkeypatch.syspath_prepend(str(tmp_path / "src"))
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    return folder


def approve(file: Path) -> Path:
    request = smsl.ApprovalRequest(smsl.read(file), "ada", WORDS, worlds=("lamp",))
    return smsl.approve(request).file


def run(file: Path, record: Path, host: str = "local") -> list[str]:
    """Run the blueprint. Return the codes of its refusals, or the reason of its end."""
    end = smsl.run(smsl.read(file), "lamp", record=record, host=host).events[-1]
    assert isinstance(end, RunFinished)
    return [one["code"] for one in end.refusals] or [end.reason]


def bytecode(source: Path, copy: Path) -> None:
    """Write ``copy``, which Python takes for the bytecode of ``source``; it is another program."""
    other, times = source.with_name("other.py"), source.stat()
    other.write_text(EVIL, "utf-8")
    os.utime(other, ns=(times.st_atime_ns, times.st_mtime_ns))
    assert other.stat().st_size == times.st_size
    py_compile.compile(str(other), cfile=str(copy), doraise=True)
    other.unlink()


@pytest.mark.parametrize("host", ["local", "process"])
def test_bytecode_beside_the_signed_source_does_not_run(
    file: Path, installed: Path, host: str, capfd: pytest.CaptureFixture[str]
) -> None:
    record = approve(file)
    tag = sys.implementation.cache_tag
    bytecode(installed / "tag.py", installed / "__pycache__" / f"tag.{tag}.pyc")
    assert run(file, record, host) == ["goal_reached"]
    said = capfd.readouterr().err
    assert ("built by good" in said, "evil" in said) == (True, False)


def test_a_module_that_the_package_does_not_list_is_another_code(
    file: Path, installed: Path
) -> None:
    record = approve(file)
    (installed / "tag").mkdir()
    (installed / "tag" / "__init__.py").write_text(EVIL, "utf-8")
    assert run(file, record) == ["code_changed", "too_few_persons"]


@pytest.mark.parametrize("host", ["local", "process"])
def test_the_source_of_an_editable_package_is_what_was_signed(
    file: Path, editable: Path, host: str, capfd: pytest.CaptureFixture[str]
) -> None:
    record = approve(file)
    assert run(file, record, host) == ["goal_reached"]
    assert "built by good" in capfd.readouterr().err
    (editable / "tag.py").write_text(EVIL, "utf-8")
    assert run(file, record, host) == ["code_changed", "too_few_persons"]


def test_what_lies_beside_an_editable_package_was_not_signed(
    file: Path, editable: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (editable.parent / "lamp_more.py").write_text("", "utf-8")
    (editable / "tag.py").write_text('import lamp_more\nTAG = "good"\n', "utf-8")
    record = approve(file)
    signed = smsl.run(smsl.read(file), "lamp", record=record, host="local")
    assert signed.reason == "refused"
    assert "lamp_more lies beside the code of a plugin" in signed.sentence
    assert "built" not in capfd.readouterr().err
    plain = smsl.run(smsl.read(file), "lamp", host="local")
    assert plain.reason == "goal_reached", "without a record it runs"


def test_code_that_cannot_be_read_file_by_file_is_missing(file: Path, installed: Path) -> None:
    record = approve(file)
    (installed / "__init__.py").rename(installed / "plugin.py")
    points = installed.parent / "lamp_pack-1.0.dist-info" / "entry_points.txt"
    points.write_text("[smsl_studio.plugins]\nlamp = lamp_pack.plugin:register\n", "utf-8")
    assert "code_missing" in run(file, record)
