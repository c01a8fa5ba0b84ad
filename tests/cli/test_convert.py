"""``convert``: the suffix names the form, nothing is lost, and a refusal leaves the target
unchanged."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import smsl_studio as smsl
from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell, sample


def digests(shell: Shell, *files: object) -> list[tuple[str, ...]]:
    answer = shell("digest", *map(str, files), "--format", "json")
    assert answer.status == 0
    kinds = ("behaviour", "meaning", "closure")
    return [tuple(one[kind] for kind in kinds) for one in answer.json["files"]]


@pytest.mark.parametrize("path", sorted(samples_dir().glob("*.json")), ids=lambda path: path.name)
def test_a_sample_keeps_its_digests_from_form_to_form(
    shell: Shell, path: Path, tmp_path: Path
) -> None:
    names = [tmp_path / name for name in ("a.smsl", "b.yaml", "c.json", "d.yml", "e.smsl")]
    for before, after in zip([path, *names], names, strict=False):
        answer = shell("convert", str(before), "-o", str(after))
        assert (answer.status, answer.out, answer.err) == (0, "", "")
    assert len(set(digests(shell, path, *names))) == 1
    assert names[0].read_bytes() == names[4].read_bytes()


def test_the_own_form_keeps_every_byte(shell: Shell, tmp_path: Path) -> None:
    texts = {
        "a.json": b'\xef\xbb\xbf{"SB": {\r\n "S": {"a":"S", "a":"S"} , "_c": 1e2}}',
        "a.smsl": b"// c\r\n,{ # NAME: SB\r\n S : [a->S,,] }",
        "a.yaml": b"# c\nSB: [ S: [a: S],  S: [] ]",
    }
    for name, raw in texts.items():
        source, target = tmp_path / name, tmp_path / f"to-{name}"
        source.write_bytes(raw)
        assert shell("convert", str(source), "-o", str(target)).status == 0
        assert target.read_bytes() == raw


def test_a_file_may_be_converted_onto_an_older_one(shell: Shell, tmp_path: Path) -> None:
    target = tmp_path / "x.yaml"
    target.write_text("old", "utf-8")
    assert shell("convert", sample("hfsm"), "-o", str(target)).status == 0
    assert target.read_text("utf-8").startswith("_comments:")
    assert [path.name for path in tmp_path.iterdir()] == ["x.yaml"]


def test_comments_that_json_cannot_hold_are_counted(shell: Shell, tmp_path: Path) -> None:
    source = tmp_path / "x.smsl"
    source.write_text("// one\n{\n    # NAME: SB // two\n    S: [ ] // three\n}\n", "utf-8")
    answer = shell("convert", str(source), "-o", str(tmp_path / "x.json"))
    assert answer.status == 0
    assert answer.err == "3 comments were left behind: JSON has no place for comments.\n"
    answer = shell("convert", str(source), "-o", str(tmp_path / "x.yaml"))
    assert (answer.status, answer.err) == (0, "")
    text = (tmp_path / "x.yaml").read_text("utf-8")
    assert all(f"# {word}\n" in text for word in ("one", "two", "three"))


REFUSED = [
    ("a.json", '{"SB": {"S": {}, "S": {}}}', "a.smsl", ":1:18: SB/S is written 2 times"),
    ("a.json", '{"SB": 5}', "a.yaml", ":1:2: 'SB' is a number"),
    ("a.yaml", "SB: [", "a.json", ":1:6: no valid YAML: a value is missing"),
    ("a.json", '{"SB": {"HEADER": {"INITIAL": 5}}}', "a.smsl", "cannot be written in the native"),
    ("a.json", "{}", "a.txt", "names no written form"),
    ("a.json", "{}", "nowhere/a.yaml", "was not saved"),
]


@pytest.mark.parametrize(("name", "text", "target", "words"), REFUSED)
def test_what_cannot_be_converted_leaves_the_target_alone(
    shell: Shell, tmp_path: Path, name: str, text: str, target: str, words: str
) -> None:
    (tmp_path / name).write_text(text, "utf-8")
    there = tmp_path / target
    if there.parent.exists():
        there.write_text("old", "utf-8")
    answer = shell("convert", str(tmp_path / name), "-o", str(there))
    assert (answer.status, answer.out) == (2, "")
    assert words in answer.err
    assert len(answer.err.splitlines()) == 2
    assert not there.parent.exists() or there.read_text("utf-8") == "old"


def test_standard_input_is_a_file_too(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    raw = Path(sample("hfsm")).read_bytes()
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(raw)))
    assert shell("convert", "-", "-o", str(tmp_path / "x.smsl")).status == 0
    assert digests(shell, tmp_path / "x.smsl") == digests(shell, sample("hfsm"))


@pytest.mark.parametrize("name", ["b.json", "b.smsl", "b.yaml"])
def test_imports_lead_to_the_same_files_from_another_folder(
    shell: Shell, tmp_path: Path, name: str
) -> None:
    (tmp_path / "inner").mkdir()
    (tmp_path / "smsl.toml").touch()
    (tmp_path / "sub.json").write_text('{"B": {"State0": {}, "State1": {}}}', "utf-8")
    source, target = tmp_path / "a.json", tmp_path / "inner" / name
    outside = tmp_path / "inner" / "no.json"
    written = '{\n "_imports": ["sub.json", "%s"],\n  "A": {"HEADER": {"SUB_SBS": {"B": 0}},'
    source.write_text(written % outside + '\n\n "State0": {}}}', "utf-8")
    answer = shell("convert", str(source), "-o", str(target))
    assert (answer.status, answer.err) == (0, f"_imports are named from the folder of {target}.\n")
    assert digests(shell, source) == digests(shell, target)
    assert "\nB:" not in target.read_text("utf-8")
    assert shell("diff", str(source), str(target)).out == "No difference.\n"
    if name == "b.json":
        text = source.read_text("utf-8").replace('"sub.json"', '"../sub.json"')
        assert target.read_text("utf-8") == text
    assert shell("convert", str(source), "-o", str(tmp_path / name)).err == ""


def test_digest_answers_for_every_file_that_can_be_read(shell: Shell, tmp_path: Path) -> None:
    (tmp_path / "bad.json").write_text("{", "utf-8")
    answer = shell("digest", sample("hfsm"), str(tmp_path / "bad.json"), sample("hanoi"))
    assert answer.status == 2
    lines = [line.split() for line in answer.out.splitlines()]
    assert [(kind, file) for _, kind, file in lines] == [
        (kind, sample(name))
        for name in ("hfsm", "hanoi")
        for kind in ("behaviour", "meaning", "closure")
    ]
    assert f"{tmp_path / 'bad.json'}:1:1: " in answer.err
    told = shell("digest", sample("hfsm"), "--format", "json").json
    assert list(told) == ["files"]
    (one,) = told["files"]
    assert list(one) == ["file", "behaviour", "meaning", "closure"]
    assert [one[kind] for kind in list(one)[1:]] == [line[0] for line in lines[:3]]


def test_moved_boxes_change_no_digest(shell: Shell, tmp_path: Path) -> None:
    values = json.loads(Path(sample("hfsm")).read_text("utf-8"))
    values["SB1"]["_layout"] = {"State000": [1, 2]}
    moved = tmp_path / "moved.json"
    moved.write_text(json.dumps(values), "utf-8")
    assert len(set(digests(shell, sample("hfsm"), moved))) == 1


@pytest.mark.parametrize(("suffix", "begin"), [("dot", "digraph {"), ("mmd", "stateDiagram-v2")])
def test_a_diagram_is_written_for_other_programs(
    shell: Shell, tmp_path: Path, suffix: str, begin: str
) -> None:
    out = tmp_path / f"out.{suffix}"
    answer = shell("convert", sample("hfsm"), "-o", str(out))
    assert (answer.status, answer.out) == (0, "")
    assert "SB1/1: That SB2 expands this fact is left out.\n" in answer.err
    assert out.read_text("utf-8").startswith(begin)
    assert smsl.convert(smsl.read(sample("hfsm")), tmp_path / f"two.{suffix}").comments_left == 0
    assert (tmp_path / f"two.{suffix}").read_bytes() == out.read_bytes()
    onto = tmp_path / f"own.{suffix}"
    onto.write_text(Path(sample("hfsm")).read_text("utf-8"), "utf-8")
    assert shell("convert", str(onto), "-o", str(onto)).status == 2
    assert shell("convert", sample("hfsm"), "-o", str(tmp_path / "no" / f"x.{suffix}")).status == 2
