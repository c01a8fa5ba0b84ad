"""Hostile names in files and plugins: no output controls a terminal, changes direction or hides
text."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.cli.calls import calls, filled, json_calls
from tests.cli.shell import Answer, Shell
from tests.hostile_names import BLUEPRINT, BOLD, MARKS, TAG, TURNS, hidden, write_hostile
from tests.plugin_folder import write_plugin
from tests.runlog.logs import chained


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return write_hostile(tmp_path)


def _is_harmless(answer: Answer) -> bool:
    for said in (answer.out, answer.err):
        assert not hidden(said), (hidden(said), said)
    return bool(answer.out or answer.err)


def test_no_command_lets_a_name_through(shell: Shell, file: Path, tmp_path: Path) -> None:
    broken = tmp_path / f"broken{TURNS}.json"
    broken.write_text(json.dumps(BLUEPRINT), "utf-8")
    no_json = tmp_path / f"none{TURNS}.json"
    no_json.write_text('{"a\u202e": \x1b', "utf-8")
    log = tmp_path / f"log{TURNS}.jsonl"
    table = ("--world", "table")
    values = {"FILE": str(file), "OTHER": str(broken), "OUT": str(tmp_path / "out")}
    values |= {"FROM": f"a{TURNS}", "TO": "b"}
    for arguments in (
        ("check", str(file), str(broken), str(no_json), f"gone{TURNS}\x1b.json"),
        ("run", str(file), *table, "--log", str(log)),
        ("run", str(broken), *table),
        ("run", str(file), "--world", f"w{TURNS}"),
        ("run", str(file), *table, "--goal", f"g{TURNS}\x1b"),
        ("run", str(file), *table, f"--no{TURNS}"),
        ("replay", str(log)),
        ("replay", str(log), "--verify"),
        ("replay", str(file), "--verify"),
        ("convert", str(file), "-o", str(tmp_path / f"x{TURNS}.none")),
        (f"command{TURNS}\x1b",),
    ):
        assert _is_harmless(shell(*arguments)), arguments
    for words in (*calls().values(), *json_calls().values()):
        answer = shell(*filled(words, values))
        assert _is_harmless(answer) or list(tmp_path.glob("out.*")), words
    for arguments in (
        ("check", str(file)),
        ("diff", str(file), str(broken)),
        ("digest", str(file)),
    ):
        answer = shell(*arguments, "--format", "json")
        assert not hidden(answer.out)
        assert TURNS in json.dumps(answer.json, ensure_ascii=False), "JSON keeps names exact"


def test_pictures_and_accounts_show_names_as_text(shell: Shell, file: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.json"
    broken.write_text(json.dumps(BLUEPRINT), "utf-8")
    log, picture, account = (tmp_path / name for name in ("log", "picture.svg", "account.html"))
    shell("run", str(file), "--world", "table", "--log", str(log))
    shell("render", str(file), "-o", str(picture))
    shell("diff", str(file), str(broken), "-o", str(tmp_path / "diff.svg"))
    shell("replay", str(log), "-o", str(account))
    for made in (picture, tmp_path / "diff.svg", account):
        text = made.read_text("utf-8")
        assert not hidden(text), made.name
        assert TAG not in text
        assert BOLD not in text
        assert "&lt;img src=x&gt;" in text
    for made in (picture, tmp_path / "diff.svg"):
        tags = {one.tag.rpartition("}")[2] for one in ElementTree.parse(made).iter()}
        assert not tags & {"img", "b", "script"}
    page = shell("render", str(file), "-o", str(tmp_path / "page.pdf"))
    assert page.status == 0, page.err


TABLE = ("--world", "table")
JSON = ("--format", "json")
OUTPUTS = {
    "check": ("check", "FILE", "OTHER"),
    "check, JSON": ("check", "FILE", "OTHER", *JSON),
    "diff": ("diff", "FILE", "OTHER"),
    "diff, JSON": ("diff", "FILE", "OTHER", *JSON),
    "diff, picture": ("diff", "FILE", "OTHER", "-o", "made.svg"),
    "digest, JSON": ("digest", "FILE", *JSON),
    "fmt, JSON": ("fmt", "--check", "FILE", *JSON),
    "picture": ("render", "FILE", "-o", "made.svg"),
    "replay": ("replay", "run.jsonl"),
    "replay, JSON": ("replay", "run.jsonl", *JSON),
    "replay, JSON, of an older log": ("replay", "older.jsonl", *JSON),
    "replay, account": ("replay", "run.jsonl", "-o", "made.html"),
    "route, JSON": ("route", "FILE", "--from", f"a{MARKS}", "--to", f"b{MARKS}", *JSON),
    "run": ("run", "FILE", *TABLE),
    "run, JSON": ("run", "FILE", *TABLE, *JSON),
    "run, log": ("run", "FILE", *TABLE, "--log", "made.jsonl"),
    "sweep, JSON": ("sweep", "FILE", *TABLE, *JSON),
}
"""One command line for each kind of output; files in capital letters hold the marks. What a new
command prints is held against hostile names above."""


@pytest.mark.parametrize("kind", OUTPUTS)
def test_no_output_has_a_mark_and_json_has_all(
    kind: str, shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    names = {key: Path(f"{key}{MARKS}.json") for key in ("FILE", "OTHER")}
    _write_marked(names["FILE"])
    _write_marked(names["OTHER"], f"more{MARKS}")
    if "replay" in kind:
        shell("run", str(names["FILE"]), *TABLE, "--log", "run.jsonl")
        _write_older(Path("run.jsonl"), Path("older.jsonl"))
    answer = shell(*(str(names.get(word, word)) for word in OUTPUTS[kind]))
    assert answer.status in (0, 1), answer.err
    made = "".join(path.read_text("utf-8") for path in sorted(tmp_path.glob("made.*")))
    told = made or answer.out
    assert "\\u202e" in told
    assert not hidden(answer.out + answer.err + made)
    if "JSON" in kind:
        values = [json.loads(line) for line in told.split("\n") if line]
        assert MARKS in json.dumps(values, ensure_ascii=False).replace("\\u007f", "\x7f")


def _write_marked(file: Path, more: str = "") -> None:
    """A blueprint of two states, whose every name has all the marks."""
    first, second = f"a{MARKS}", f"b{MARKS}"
    states = {first: {f"go{MARKS}": second}, second: {f"back{MARKS}": first}}
    if more:
        states[second][more] = f"gone{MARKS}"
    header = {"INITIAL": first, "ACTIVATING": second, "NUM_FACTS": 1}
    facts = {"0": {"name": f"fact{MARKS}", "values": {"1": f"on{MARKS}"}}}
    titles = {first: {"title": f"title{MARKS}"}}
    branch = {"HEADER": header, "_facts": facts, "_states": titles, **states}
    file.write_text(json.dumps({f"SB{MARKS}": branch}, ensure_ascii=False), "utf-8")


def _write_older(log: Path, older: Path) -> None:
    """The same log as the version before wrote it: with the marks as they are."""
    lines = [json.loads(line) for line in log.read_text("utf-8").split("\n") if line]
    for line in lines[:-1]:
        del line["chain"]
    texts = [json.dumps(one, ensure_ascii=False, separators=(",", ":")) for one in lines[:-1]]
    older.write_bytes(chained([text.encode() for text in texts]))
    assert hidden(older.read_text("utf-8"))


def test_what_plugins_say_of_themselves_is_shown_as_text(
    shell: Shell, home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    nasty = TURNS + "\\u001b[31m" + TAG
    for place in (home / "plugins", tmp_path / f"path{TURNS}\x1b"):
        folder = write_plugin(place, "lamp", f"raise ValueError('{TURNS}\\x1b[31m')")
        words = f'name = "lamp"\nversion = "{nasty}"\ndescription = "{nasty}\\nline"\n'
        (folder / "plugin.toml").write_text(f'{words}worlds = ["{nasty}"]\n', "utf-8")
    write_plugin(home / "plugins", f"bad{TURNS}", "")
    (home / "plugins" / f"bad{TURNS}" / "plugin.toml").write_text(f'name = "{nasty}"\n', "utf-8")
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(tmp_path / f"path{TURNS}\x1b"))
    allow = ("plugins", "allow")
    commands = [("plugins",), ("worlds",), (*allow, "lamp"), (*allow, f"la{TURNS}")]
    for arguments in (*commands, ("plugins", "--format", "json")):
        assert _is_harmless(shell(*arguments)), arguments
