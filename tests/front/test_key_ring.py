"""Keys from Python: a store that is made is private, and a store of others is not believed."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.errors import SealError
from tests.approval import make_keys_cheap

WORDS = b"correct horse"


@pytest.fixture(autouse=True)
def _cheap(monkeypatch: pytest.MonkeyPatch) -> None:
    make_keys_cheap(monkeypatch)


def test_a_store_that_is_made_is_for_its_owner_alone(home: Path) -> None:
    before = os.umask(0)
    try:
        smsl.make_key("Ada", "engineer", WORDS, "ada")
    finally:
        os.umask(before)
    made = (home, home / "store", home / "store" / "keys")
    assert [stat.S_IMODE(one.stat().st_mode) for one in made] == [0o700] * 3
    files = [path for path in (home / "store").rglob("*") if path.is_file()]
    assert {stat.S_IMODE(path.stat().st_mode) for path in files} == {0o600}
    assert [one.id for one in smsl.list_keys()] == ["ada"]


def test_a_store_that_others_may_write_is_not_believed(home: Path) -> None:
    smsl.make_key("Ada", "engineer", WORDS, "ada")
    keys = home / "store" / "keys"
    for path, mode in ((keys / "ada.json", 0o622), (keys, 0o777)):
        kept = path.stat().st_mode
        path.chmod(mode)
        with pytest.raises(SealError, match="may be written by everybody"):
            smsl.list_keys()
        path.chmod(kept)
    assert len(smsl.list_keys()) == 1
    (keys / "eve.json").symlink_to(keys / "ada.json")
    with pytest.raises(SealError):
        smsl.list_keys()


def test_a_copy_under_another_name_is_the_same_key(home: Path, tmp_path: Path) -> None:
    made = smsl.make_key("Ada", "engineer", WORDS, "ada")
    smsl.export_key("ada", tmp_path / "ada.pub")
    assert smsl.import_key(tmp_path / "ada.pub", "other") == made, "it keeps its name and its half"
    smsl.revoke_key("ada", "lost", WORDS)
    assert smsl.import_key(tmp_path / "ada.pub").revoked == "lost"


def test_a_file_revokes_no_key_and_brings_no_revoked_one(home: Path, tmp_path: Path) -> None:
    """Anybody can write such a file, and no passphrase is needed to take it in."""
    smsl.make_key("Ada", "engineer", WORDS, "ada")
    file = tmp_path / "ada.pub"
    smsl.export_key("ada", file)
    file.write_text(file.read_text().replace('"revoked": ""', '"revoked": "because"'))
    with pytest.raises(SealError, match="a file cannot revoke a key"):
        smsl.import_key(file)
    assert [one.revoked for one in smsl.list_keys()] == [""]
    file.write_text(file.read_text().replace('"ada"', '"other"').replace('"Ada"', '"Eve"'))
    with pytest.raises(SealError, match="a file cannot revoke a key"):
        smsl.import_key(file)
