"""Hostile files of other programs: a sentence with a place, nothing run, nothing fetched."""

from __future__ import annotations

import os
import socket
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.errors import ReadError
from smsl_studio.front.exchanges import Imported
from smsl_studio.smsl.document.limits import LARGEST_FILE
from tests.exchange import foreign
from tests.exchange.again import read_text
from tests.exchange.broken import CORE, NAMES, broken, put, sources

PART = 100
"""A twentieth of the files; ``python -m benches exchange`` tries all."""

WATCH: list[tuple[str, Any]] = []
SHUT = ("socket.", "subprocess.", "os.system", "os.exec", "os.posix_spawn", "urllib.")


def _hear(event: str, arguments: tuple[Any, ...]) -> None:
    if WATCH and (event == "open" or event.startswith(SHUT)):
        WATCH.append((event, arguments[0] if arguments else ""))


sys.addaudithook(_hear)


@contextmanager
def watched() -> Iterator[list[tuple[str, Any]]]:
    """The files that are opened meanwhile, and every attempt to connect or to start a program."""
    WATCH.append(("begin", ""))
    heard: list[tuple[str, Any]] = []
    try:
        yield heard
    finally:
        heard += WATCH[1:]
        WATCH.clear()


@pytest.mark.parametrize("name", NAMES)
def test_a_broken_file_opens_or_is_refused(name: str, tmp_path: Path) -> None:
    for text in ("x.scxml", "x.graphml", "x.xstate.json", "x.py"):  # everything is loaded once
        smsl.imported(put(_good(text), text, tmp_path / "warm"))
    opened = refused = 0
    for number, raw in enumerate(broken(1, PART, name)):
        file = put(raw, name, tmp_path / str(number))
        with watched() as heard:
            answer = _answer(file)
        if isinstance(answer, ReadError):
            refused += 1
            assert answer.sentence
            assert answer.advice
            assert answer.place is not None
        else:
            opened += 1
            assert smsl.digest(answer.blueprint)
            assert all(one.message and one.kind for one in answer.findings)
        outside = [one for event, one in heard if event != "open" or not _is_inside(one, tmp_path)]
        assert outside == []
    assert min(opened, refused) > 0


def _answer(file: Path) -> Imported | ReadError:
    try:
        return smsl.imported(file)
    except ReadError as error:
        return error


def _good(name: str) -> bytes:
    return sources()[name][0].encode()


def _is_inside(file: Any, folder: Path) -> bool:
    if isinstance(file, int):
        return True  # a handle of a folder that was opened before
    path = os.fsdecode(file)
    if not os.path.isabs(path):  # noqa: PTH117 -- opened below a handle
        return True
    return (
        path.startswith(str(folder))
        or str(folder).startswith(path)
        or path.endswith((".py", ".pyc", ".so"))
    )


BOMB = '<!DOCTYPE a [<!ENTITY a "aaaaaaaaaa">' + "".join(
    f'<!ENTITY a{n} "{f"&a{n - 1 if n > 1 else str()};" * 10}">' for n in range(1, 10)
)
BOMBS = {
    "entities": BOMB + "]><{root}>&a9;</{root}>",
    "external": '<!DOCTYPE a [<!ENTITY a SYSTEM "{secret}">]><{root} id="&a;">&a;</{root}>',
    "parameter": '<!DOCTYPE a [<!ENTITY % a SYSTEM "{secret}"> %a;]><{root}/>',
    "external dtd": '<!DOCTYPE a SYSTEM "{secret}"><{root}/>',
    "default": '<!DOCTYPE a [<!ATTLIST state x CDATA "' + "y" * 100_000 + '">]><{root}/>',
}


@pytest.mark.parametrize("root", ["scxml", "graphml", "behavior"])
@pytest.mark.parametrize("name", BOMBS)
def test_no_entity_and_no_document_type_is_read(name: str, root: str, tmp_path: Path) -> None:
    secret = tmp_path / "secret.txt"
    secret.write_text("a secret", "utf-8")
    text = BOMBS[name].replace("{root}", root).replace("{secret}", secret.as_uri())
    suffix = {"behavior": "xml"}.get(root, root)
    file = put(text.encode(), f"x.{suffix}", tmp_path / "in")
    with watched() as heard, pytest.raises(ReadError, match="a document type or an entity") as told:
        smsl.imported(file)
    assert "secret" not in str(told.value).replace(str(tmp_path), "")
    assert not any(str(one).endswith("secret.txt") for _, one in heard)


def test_includes_and_sources_are_told_and_not_opened(tmp_path: Path) -> None:
    text = """<scxml xmlns="http://www.w3.org/2005/07/scxml" xmlns:xi="http://www.w3.org/2001/XInclude"
      version="1.0"><xi:include href="x.scxml"/><state id="a" src="x.scxml">
      <invoke src="http://127.0.0.1:9/"/><onentry><script>boom()</script></onentry></state></scxml>"""
    file = put(text.encode(), "x.scxml", tmp_path)
    with watched() as heard:
        blueprint, findings = smsl.imported(file)
    assert list(blueprint["SB1"].table) == ["a"]
    assert {one.kind for one in findings} >= {"include", "source", "invoke", "onentry"}
    assert sum(str(one).endswith("x.scxml") for _, one in heard) == 1


@pytest.mark.parametrize("name", ["x.scxml", "x.graphml", "x.xstate.json", "x.py", "x.xml"])
def test_a_hundred_megabytes_are_refused(name: str, tmp_path: Path) -> None:
    file = tmp_path / name
    with file.open("wb") as stream:
        stream.truncate(100 << 20)
    with pytest.raises(ReadError, match=f"the file is larger than {LARGEST_FILE >> 20} MB"):
        smsl.imported(file)


DEEP: dict[str, Callable[[], str]] = {
    "x.scxml": lambda: "<scxml>" + "<state>" * 100_000,
    "x.graphml": lambda: "<graphml><graph>" + "<node id='a'><graph>" * 50_000,
    "x.xstate.json": lambda: '{"states": {"a": ' * 100_000,
    "x.py": lambda: "x = " + "(" * 100_000,
    "y.py": lambda: "x = " + "-" * 100_000 + "1",
    "z.py": lambda: "x = a" + ".a" * 100_000,
    "x.xml": lambda: "<behavior>" * 100_000,
}
"""How the texts are made. They are long, so each is made where it is read only."""
WIDE: dict[str, Callable[[], str]] = {
    "x.scxml": lambda: "<scxml>" + "<state/>" * 600_000,
    "y.scxml": lambda: "<scxml " + " ".join(f"a{n}='1'" for n in range(600_000)) + "/>",
    "x.graphml": lambda: "<graphml><graph>" + "<data/>" * 600_000,
    "x.xstate.json": lambda: '{"states": {' + ",".join(f'"{n}":1' for n in range(600_000)) + "}}",
    "x.py": lambda: "x = 1\n" * 300_000,
}


@pytest.mark.parametrize(("name", "text"), [*DEEP.items(), *WIDE.items()], ids=[*DEEP, *WIDE])
def test_depth_and_number_are_bounded(name: str, text: Callable[[], str], tmp_path: Path) -> None:
    with pytest.raises(ReadError):
        smsl.imported(put(text().encode(), name, tmp_path))


def test_many_inherited_transitions_are_bounded() -> None:
    events = "".join(f'<transition event="e{n}" target="s0"/>' for n in range(2_000))
    states = "".join(f'<state id="s{n}"/>' for n in range(2_000))
    text = f'<scxml><state id="A">{events}{states}</state></scxml>'
    with pytest.raises(ReadError, match="more than 400,000 operations"):
        read_text(text, "x.scxml")


def test_many_findings_are_counted() -> None:
    text = f"<scxml>{'<script/>' * 1_500}<state id='a'/></scxml>"
    _, findings = read_text("".join(text.replace("<script/>", "<script/>\n")), "x.scxml")
    assert len(findings) == 1_001
    assert findings[-1].message == "501 further findings are not listed."


def test_containers_that_contain_each_other_end(tmp_path: Path) -> None:
    made = "\n".join(
        f"  s{n} = OperatableStateMachine(outcomes=['o'])\n  with s{n}:\n"
        f"   A.add('a', s{n - 1 if n else 3}, transitions={{'o': 'o'}})\n"
        f"   A.add('b', s{n - 1 if n else 3}, transitions={{'o': 'o'}})"
        for n in range(30)
    )
    text = f"class A:\n def create(self):\n{made}\n  return s29\n"
    with pytest.raises(ReadError, match="more than 50,000 states"):
        smsl.imported(put(text.encode(), "x.py", tmp_path))


def test_links_do_not_lead_out_of_a_machine(tmp_path: Path) -> None:
    folder = tmp_path / "machine"
    foreign.write_rafcon(folder)
    (tmp_path / "secret").mkdir()
    foreign.write_state(tmp_path / "secret", "S", "Secret", "ExecutionState", ["done"], [])
    (folder / "Home_HOME" / "loop").symlink_to(folder)
    (folder / "Stolen_S").symlink_to(tmp_path / "secret")
    blueprint, _ = smsl.imported(folder)
    assert "Secret" not in blueprint["Drill"].table
    (folder / "Home_HOME" / CORE).unlink()
    (folder / "Home_HOME" / CORE).symlink_to(tmp_path / "secret" / CORE)
    with pytest.raises(ReadError, match="a link leads out"):
        smsl.imported(folder)


def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "x.scxml")
    with pytest.raises(ReadError, match="no ordinary file"):
        smsl.imported(tmp_path / "x.scxml")
    with socket.socket(socket.AF_UNIX) as one:
        one.bind(str(tmp_path / "x.graphml"))
        with pytest.raises(ReadError, match="no ordinary file"):
            smsl.imported(tmp_path / "x.graphml")
