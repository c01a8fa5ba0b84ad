"""The parent's end of a child's pipe: valid frames in pieces, and bytes that are no valid frame."""

from __future__ import annotations

import ast
import os
import re
import socket
import struct
from collections.abc import Iterator
from pathlib import Path

import pytest

import smsl_studio
from smsl_studio.host.bounds import Outlet
from smsl_studio.host.wire import ChildWire, NoAnswer, Wire, WireFrame

Ends = tuple[Wire, socket.socket]


@pytest.fixture
def ends() -> Iterator[Ends]:
    ours, theirs = socket.socketpair()
    wire = Wire(ours, largest=100)
    yield wire, theirs
    wire.close()
    theirs.close()


def _frame(number: int, kind: int, body: bytes, size: int | None = None) -> bytes:
    return struct.pack("!IIB", len(body) if size is None else size, number, kind) + body


def test_a_command_is_answered(ends: Ends) -> None:
    wire, theirs = ends
    child = ChildWire(theirs)
    wire.send("begin", ("here", 1))
    assert child.receive() == ("begin", ("here", 1))
    child.send("loads", b"one")
    child.send("ok", b"two")
    assert wire.read() == WireFrame("loads", b"one")
    assert wire.come() == WireFrame("ok", b"two")
    assert wire.come() is None
    assert wire.read() is None


def test_an_answer_that_trickles_is_whole_in_the_end(ends: Ends) -> None:
    wire, theirs = ends
    wire.send("tick")
    told = []
    for byte in _frame(1, 0, b"all of it"):
        theirs.send(bytes([byte]))
        told.append(wire.read())
    assert told[-1] == WireFrame("ok", b"all of it")
    assert not any(told[:-1])


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (_frame(1, 0, b"", 101), "it has 101 bytes, more than 100"),
        (_frame(1, 0, b"", 2**32 - 1), "4294967295 bytes"),
        (_frame(1, 4, b""), "of kind 4, which there is not"),
        (_frame(0, 0, b""), "nothing was asked that it answers"),
        (_frame(2, 0, b""), "nothing was asked that it answers"),
        (_frame(1, 0, b"") + b"\0", "something stands behind it"),
        (_frame(1, 0, b"") * 2, "something stands behind it"),
        (_frame(1, 3, b"") + _frame(2, 0, b""), "nothing was asked"),
        (b"\x80\x04\x95garbage", "bytes, more than"),
    ],
)
def test_what_is_no_answer_is_said_to_be_none(ends: Ends, data: bytes, words: str) -> None:
    wire, theirs = ends
    wire.send("tick")
    theirs.send(data)
    with pytest.raises(NoAnswer, match=words):
        _all(wire)


def _all(wire: Wire) -> list[WireFrame]:
    found = [wire.read()]
    while found[-1] is not None:
        found.append(wire.come())
    return [frame for frame in found if frame is not None]


def test_what_comes_before_it_is_asked_for_is_none(ends: Ends) -> None:
    wire, theirs = ends
    theirs.send(_frame(0, 0, b""))
    with pytest.raises(NoAnswer, match="nothing was asked"):
        wire.read()


def test_a_second_answer_is_none_to_the_next_command(ends: Ends) -> None:
    wire, theirs = ends
    wire.send("tick")
    theirs.send(_frame(1, 0, b""))
    assert wire.read() == WireFrame("ok", b"")
    theirs.send(_frame(1, 0, b""))
    wire.send("tick")
    with pytest.raises(NoAnswer, match="nothing was asked"):
        wire.read()


def test_a_child_that_does_not_read_holds_nobody(ends: Ends) -> None:
    wire, theirs = ends
    wire.send("costs", ("x" * 10**7,))
    assert wire.sending
    wire.flush()
    assert wire.sending
    theirs.close()
    with pytest.raises(OSError, match=r"pipe|reset"):
        wire.flush()


def test_the_end_is_told(ends: Ends) -> None:
    wire, theirs = ends
    wire.send("tick")
    theirs.shutdown(socket.SHUT_WR)
    with pytest.raises(EOFError):
        wire.read()


def test_pickles_are_read_by_the_child_alone() -> None:
    """In the whole package: what a child tells is never unpickled, by no library either."""
    reads = r"\b(pickle\.load|Unpickler|marshal|shelve\b|multiprocessing)"
    found = [
        (path.name, getattr(node, "name", "an import"))
        for path in Path(smsl_studio.__file__).parent.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, (ast.ClassDef, ast.Import, ast.ImportFrom))
        and re.search(reads, ast.unparse(node))
    ]
    assert found == [("wire.py", "ChildWire")]


@pytest.fixture
def said() -> Iterator[tuple[Outlet, int]]:
    read, write = os.pipe()
    os.set_blocking(read, False)
    outlet = Outlet(read, most=10)
    yield outlet, write
    os.close(write)
    outlet.close()


def test_what_is_printed_steers_nothing_and_ends(
    said: tuple[Outlet, int], capsys: pytest.CaptureFixture[str]
) -> None:
    outlet, write = said
    assert outlet.pass_on()
    os.write(write, "a\x1b[2J\r\u202e\x9b\n".encode() + b"\xff")
    assert outlet.pass_on()
    assert capsys.readouterr().err == "a\\x1b[2J\\u202e\\x9b\n\ufffd"
    os.write(write, b"and so on for ever")
    assert outlet.pass_on()
    assert capsys.readouterr().err == "a\n... more is printed, and not shown\n"
    os.write(write, b"and on")
    assert outlet.pass_on()
    assert capsys.readouterr().err == ""
