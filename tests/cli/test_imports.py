"""A foreign blueprint names files outside its project: no command opens, quotes or records them."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from smsl_studio.front.key_ring import make_key
from tests.cli.calls import calls, filled, json_calls
from tests.cli.shell import Shell

SECRET = "topsecret"
SHADOW = f"root:$6${SECRET}:19000:0:99999:7:::\n"


@pytest.fixture
def hostile(tmp_path: Path) -> Path:
    """A blueprint that names what it should not, in a folder of its own."""
    (tmp_path / "shadow").write_text(SHADOW)
    (tmp_path / "theirs.json").write_text(f'{{"{SECRET}": {{"State0": {{}}}}}}')
    folder = tmp_path / "from-anybody"
    folder.mkdir()
    os.mkfifo(folder / "pipe.json")
    (folder / "x.json").symlink_to(tmp_path / "shadow")
    (folder / "y.json").symlink_to(tmp_path / "theirs.json")
    (folder / "z.json").symlink_to("/proc/kmsg")
    (folder / "faulty.yaml").write_text("{" + SHADOW)
    file = folder / "a.json"
    names = [
        str(tmp_path / "shadow"),
        "../shadow",
        "../theirs.json",
        "x.json",
        "y.json",
        "z.json",
        "pipe.json",
        "faulty.yaml",
    ]
    branch = {"State0": {"o": "State1"}, "State1": {}}
    file.write_text(json.dumps({"_imports": names, "SB1": branch}))
    return file


def test_what_is_named_is_neither_quoted_nor_drawn_nor_recorded(
    shell: Shell, hostile: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_key("Ada", "engineer", b"open", "KEY")
    monkeypatch.setenv("SMSL_PASSPHRASE", "open")
    out = hostile.with_name("out")
    other = hostile.with_name("other.json")
    other.write_text("{}")
    commands = (
        ("check", 1),
        ("check --format json", 1),
        (f"render -o {out}.svg", 0),
        (f"render -o {out}.pdf", 0),
        (f"convert -o {out}.smsl", 0),
        (f"diff {other}", 1),
        (f"diff {other} --format json -o {out}-diff.svg", 1),
        ("digest", 0),
        ("fmt --check", 1),
        ("route --from State0 --to State1", 0),
        (f"run --world table --log {out}.jsonl", 1),
        ("sweep --world table", 0),
    )
    for words, status in commands:
        name, *more = words.split()
        answer = shell(name, str(hostile), *more)
        assert answer.status == status, (words, answer.err)
        assert SECRET not in answer.out + answer.err, words
    values = {"FILE": str(hostile), "OTHER": str(other)}
    values |= {"SB": "SB1", "FROM": "State0", "TO": "State1"}
    for line in (*calls().values(), *json_calls().values()):
        answer = shell(*filled(line, {**values, "OUT": f"{out}-any"}))
        assert answer.status in (0, 1), (line, answer.err)
        assert SECRET not in answer.out + answer.err, line
    written = list(hostile.parent.glob("out*"))
    assert len(written) >= 5
    assert not any(SECRET.encode() in path.read_bytes() for path in written)
    found = shell("check", str(hostile), "--rule", "R08", "--format", "json").json["files"][0]
    assert [one["rule"] for one in found["findings"]] == ["R08"] * 8
    assert all(one["line"] == 1 and one["advice"] for one in found["findings"])


def test_as_driver_of_git_it_follows_nothing_either(
    shell: Shell, hostile: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    before = tmp_path / "git-blob"
    before.write_text("{}")
    name = "from-anybody/a.json"
    answer = shell("diff", name, str(before), "0", "100644", str(hostile), "1", "100644")
    assert answer.status == 0
    assert "SB1" in answer.out
    assert SECRET not in answer.out + answer.err
