"""Programs that flood, drip, close or say nothing: each is sent away in bounded time and memory."""

from __future__ import annotations

import select
import socket
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.channel import door as doors
from smsl_studio.channel.address import ChannelAddress
from smsl_studio.channel.door import Door
from smsl_studio.channel.frames import FrameBuffer
from smsl_studio.front import read
from smsl_studio.front.served_worlds import WorldBuilder, serve_once
from smsl_studio.host.served_world import ServedWorld
from smsl_studio.shipped import samples_dir
from tests.channel.frame_trials import BEGIN, START, framed

TOKEN = "0123456789abcdef"
HELLO = framed({"n": 1, "ask": "hello", "version": 1, "token": TOKEN})


class Room:
    """A served table world, and the programs that connect to it."""

    def __init__(self, folder: Path, wants: bool = False) -> None:
        self.address = ChannelAddress("unix:d", path=str(folder / "d"))
        self.door = Door(self.address.listening(), TOKEN)
        builder = WorldBuilder("table")
        builder.own = None if wants else read(samples_dir() / "hanoi-2.json")
        self.served = ServedWorld("table", builder.build, wants)
        self.told: list[Any] = []

    def program(self, said: bytes = b"") -> socket.socket:
        end = self.address.connected(5.0)
        end.setblocking(True)
        end.sendall(said)
        return end

    def look(self, times: int = 1) -> None:
        for _ in range(times):
            serve_once(self.door, self.served, self.told.append, 0.0)

    def answer(self, end: socket.socket) -> Any:
        """The next answer to a program; None if it is sent away without one."""
        buffer = FrameBuffer(1 << 22)
        while (found := buffer.take()) is None:
            while not select.select([end], [], [], 0)[0]:
                self.look()
            piece = end.recv(65536)
            if not piece:
                return None
            buffer.add(piece)
        return found

    def inside(self) -> tuple[socket.socket, str]:
        """A program that is inside, with the word of its session."""
        end = self.program(HELLO)
        return end, self.answer(end)["session"]

    def close(self) -> None:
        self.served.close()
        self.door.close()
        self.address.forget()


@pytest.fixture
def room(tmp_path: Path) -> Iterator[Room]:
    own = Room(tmp_path)
    yield own
    own.close()


@pytest.fixture
def brief(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doors, "PATIENCE", 0.02)


@pytest.mark.parametrize(
    ("hello", "said"),
    [
        ({"n": 1, "ask": "hello", "version": 1}, "the token is not the right one"),
        ({"n": 1, "ask": "hello", "version": 1, "token": TOKEN[:-1]}, "the token is not the right"),
        ({"n": 1, "ask": "hello", "version": 1, "token": [TOKEN]}, "the token is not the right"),
        ({"n": 1, "ask": "hello", "version": 2, "token": TOKEN}, "version is 2, not 1"),
        ({"n": 1, "ask": "hello", "version": True, "token": TOKEN}, "version is True, not 1"),
        ({"n": 1, "ask": "open", "version": 1, "token": TOKEN}, "the first question must be"),
        ({"n": 2, "ask": "hello", "version": 1, "token": TOKEN}, "the first question must be"),
        ({"pad": "x" * 5000}, "a frame of 5,011 bytes, not of 1 to 4,096"),
    ],
)  # fmt: skip
def test_who_does_not_come_in(room: Room, hello: Any, said: str) -> None:
    with room.program(framed(hello)) as end:
        answer = room.answer(end)
    assert answer["answer"] == "refused"
    assert said in answer["sentence"]
    assert not room.door.taken


def test_a_second_program_is_refused_and_the_first_goes_on(room: Room) -> None:
    first, session = room.inside()
    with first, room.program(HELLO) as second:
        assert room.answer(second)["sentence"] == "another program is connected"
        first.sendall(framed({"n": 2, "ask": "open", "session": session, "start": START}))
        assert room.answer(first)["answer"] == "open"


def test_many_who_wait_are_too_many(room: Room) -> None:
    ends = []
    for _ in range(30):
        ends.append(room.program())
        room.look()
    assert room.door.refusals == 30 - doors.MOST_WAITING
    for one in ends:
        one.close()
    room.look()
    end, _ = room.inside()
    end.close()


@pytest.mark.usefixtures("brief")
def test_who_drips_or_says_nothing_is_sent_away(room: Room) -> None:
    with room.program(HELLO[:7]) as end:
        assert "a frame was not whole after" in room.answer(end)["sentence"]
    with room.program() as end:
        assert "it has said nothing" in room.answer(end)["sentence"]


@pytest.mark.usefixtures("brief")
def test_who_is_inside_and_silent_loses_the_world(room: Room) -> None:
    for rest, words in ((b"", "it has said nothing for"), (b"\0\0", "a frame was not whole after")):
        end, _ = room.inside()
        with end:
            end.sendall(rest)
            while room.door.taken:
                room.look()
        assert words in room.told[-1]["reason"]
        assert room.told[-1]["braked"]


def test_a_flood_is_not_kept(room: Room) -> None:
    end, session = room.inside()
    with end:
        end.sendall(framed({"n": 2, "ask": "open", "session": session, "start": START}))
        assert room.answer(end)["answer"] == "open"
        end.setblocking(False)
        with suppress(BlockingIOError):  # until the system keeps no more for it
            while True:
                end.send(b"\0\0\xff\xff" + b"x" * 60_000)
        while room.door.taken:
            room.look()
    assert "a frame that is no JSON" in room.told[-1]["reason"]
    assert room.served.begun == 0


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"ask": "begin", "operation": "SB1/State_aa/Op_9z", "function": "table.set_facts"},
         "an operation was begun that is not offered"),
        ({**BEGIN, "ask": "begin", "function": "other"}, "that is not offered"),
        ({**BEGIN, "ask": "begin", "operation": 7}, "operation is 7, not a text"),
        ({"ask": "dance"}, "there is no such question"),
        ({"ask": "open", "start": START}, "open came twice"),
        ({"ask": "stop", "mode": "softly"}, "mode is 'softly', not one of"),
        ({"ask": "inject", "fault": 1}, "fault is 1, not a text"),
        ({"ask": "inject", "fault": "x", "parameters": {"a": []}}, "parameter is a value of type"),
    ],
)  # fmt: skip
def test_questions_that_are_none_end_the_connection(room: Room, asked: Any, words: str) -> None:
    end, session = room.inside()
    with end:
        end.sendall(framed({"n": 2, "ask": "open", "session": session, "start": START}))
        assert room.answer(end)["answer"] == "open"
        end.sendall(framed({"n": 3, "session": session, **asked}))
        assert room.answer(end) is None
    assert words in room.told[-1]["reason"]
    assert (room.told[-1]["braked"], room.served.begun) == (True, 0)


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ({}, "no blueprint was sent"),
        ({"blueprint": [{"file": "a", "form": "json", "text": "{"}]}, "a:1:"),
        ({"blueprint": [{"file": "a", "form": "json", "text": "{}"}]}, ""),
        ({"blueprint": [{"file": "../../x.json", "form": "json", "text": "[" * 9000}]}, "x.json:1"),
    ],
)
def test_blueprints_that_are_none_are_refused(tmp_path: Path, said: Any, words: str) -> None:
    room = Room(tmp_path, wants=True)
    try:
        end, session = room.inside()
        with end:
            end.sendall(framed({"n": 2, "ask": "open", "session": session, "start": {}, **said}))
            answer = room.answer(end)
            assert words in answer.get("sentence", "")
            end.sendall(framed({"n": 3, "ask": "begin", "session": session, **BEGIN}))
            assert room.answer(end) is None
        assert room.served.begun == 0
    finally:
        room.close()
