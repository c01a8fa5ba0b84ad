"""Random histories of records: Studio and ``verify.py`` say the same about each of them."""

from __future__ import annotations

import io
import json
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

import smsl_studio as smsl
from smsl_studio.errors import StudioError
from smsl_studio.front.bundles import bundled
from smsl_studio.front.former_record import changes_since_record
from smsl_studio.front.signed_files import SignedPaths
from tests.approval import DOOR, make_keys_cheap

WORDS = b"correct horse"
PEOPLE = (("Ada", "engineer", "ada"), ("ADA ", "surgeon", "ada-2"), ("Ben", "surgeon", "ben"),
          ("Eve", "engineer", "eve"), ("CI", "automatic", "ci"),
          ("Room", "recorder", "room"))  # fmt: skip
OTHER = {"DOOR": {**DOOR["DOOR"], "State_1": {"shut": "State_0"}}}
TEXTS = ("it is dry", "it is lit")
LINES = ("persons = 2", "persons = 3", "roles = { engineer = 1 }",
         "roles = { engineer = 1, surgeon = 1 }", 'automatic = "may_sign"')  # fmt: skip
HISTORIES = (2, 8, 9, 13, 33, 36)
"""In these the two have differed once."""


def sign(file: Path, key: str, random: Random) -> None:
    """Let somebody say something about the file as it stands. What is refused is left out."""
    dice, said = random.random(), smsl.ApprovalRequest(smsl.read(file), key, WORDS)
    if dice < 0.12:
        said = replace(said, verdict="rejected")
    elif dice < 0.35:
        said = replace(said, conditions=(random.choice(TEXTS),))
    elif dice < 0.6:
        said = replace(said, met=tuple(random.sample(TEXTS, random.randint(1, 2))))
    _, changes = changes_since_record(said.blueprint)
    known = tuple(f"{one.rule}@{one.address}=it is known" for one in changes)
    try:
        smsl.approve(replace(said, dispositions=known))
    except StudioError:
        return


def history(folder: Path, random: Random) -> tuple[Path, Path]:
    """A file with a record of some people, and a policy."""
    file, policy = folder / "door.json", folder / "policy.toml"
    for person, role, key in PEOPLE:
        smsl.make_key(person, role, WORDS, key)
    for _ in range(random.randint(1, 6)):
        file.write_text(json.dumps(OTHER if random.random() < 0.12 else DOOR))
        sign(file, random.choice(PEOPLE)[2], random)
    file.write_text(json.dumps(DOOR))
    lines = {line.partition(" ")[0]: line for line in random.sample(LINES, random.randint(0, 2))}
    policy.write_text("\n".join(lines.values()))
    return file, policy


@pytest.mark.parametrize("number", HISTORIES)
def test_both_judge_a_random_history_alike(
    number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_keys_cheap(monkeypatch)
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "home"))
    file, policy = history(tmp_path, Random(f"history {number}"))
    blueprint = smsl.read(file)
    found = smsl.verify_approval(blueprint, policy=policy)
    raw = bundled(blueprint, "out.zip", [], SignedPaths(None, str(policy)))
    zipfile.ZipFile(io.BytesIO(raw)).extractall(tmp_path / "out")
    done = subprocess.run(
        [sys.executable, "verify.py"], cwd=tmp_path / "out", capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert done.stderr == ""
    agreed = (done.returncode == 0) == (found.verdict == "approved")
    nobody = [one.code for one in found.refusals] == ["no_record"]
    assert agreed or nobody, (found.refusals, done.stdout)
