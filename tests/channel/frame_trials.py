"""Frames that are random, cut, doubled, out of order or of another session, drawn from a number.

Each trial says hello to a served table world, opens it, and then sends bytes in which no frame is
the next one that may come. So no operation may begin.
"""

from __future__ import annotations

import json
import select
import struct
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

from smsl_studio.channel.address import ChannelAddress
from smsl_studio.channel.door import Door
from smsl_studio.channel.frames import LARGEST, FrameBuffer
from smsl_studio.front import read
from smsl_studio.front.served_worlds import serve_once
from smsl_studio.host.local import LocalHost
from smsl_studio.host.served_world import ServedWorld
from smsl_studio.shipped import samples_dir

START = {"SB1": "State_aa"}
BEGIN = {"operation": "SB1/State_aa/Op_1b", "function": "table.set_facts"}
Frame = dict[str, Any]


def framed(frame: object) -> bytes:
    written = frame if isinstance(frame, bytes) else json.dumps(frame).encode()
    return struct.pack("!I", len(written)) + written


def good(number: int, session: str) -> list[bytes]:
    """Frames that would begin operations, if they came in their order from ``number`` on."""
    verbs: list[Frame] = [
        {"ask": "begin", **BEGIN},
        {"ask": "tick"},
        {"ask": "stop", "mode": "hold"},
    ]
    return [
        framed({"n": number + at, "session": session, **frame})
        for at, frame in enumerate([*verbs, *verbs, *verbs])
    ]


def noise(chance: Random, session: str) -> bytes:
    """Random bytes; some have a true length in front."""
    raw = chance.randbytes(chance.randrange(1, 300))
    return framed(raw) if chance.random() < 0.5 else raw


def values(chance: Random, session: str) -> bytes:
    """JSON in which anything may stand at any key."""
    odd: list[Any] = [
        None,
        True,
        -1,
        0,
        1,
        2,
        3,
        1e308,
        "",
        "begin",
        "tick",
        [],
        {},
        [[]],
        "\ud800",
        2**70,
    ]
    keys = ["n", "ask", "session", "operation", "function", "mode", "fault", "parameters"]
    frame = {key: chance.choice(odd) for key in chance.sample(keys, chance.randrange(1, 8))}
    if frame.get("n") == 3 and not isinstance(frame["n"], bool):
        frame["n"] = 4
    return framed(frame) + b"".join(good(4, session))


def cut(chance: Random, session: str) -> bytes:
    """The beginning of a frame is missing, or its end, and others follow."""
    first, *rest = good(3, session)
    at = chance.randrange(1, len(first))
    return (first[at:] if chance.random() < 0.5 else first[:at]) + b"".join(rest)


def out_of_order(chance: Random, session: str) -> bytes:
    """Frames in another order, of which the first is not the next one."""
    first, *rest = good(3, session)
    chance.shuffle(rest)
    rest.insert(chance.randrange(1, len(rest)), first)
    return b"".join(rest)


def replayed(chance: Random, session: str) -> bytes:
    """Frames of another session, or numbers that have been."""
    if chance.random() < 0.5:
        return b"".join(good(3, f"{chance.getrandbits(64):016x}"))
    return b"".join(good(chance.randrange(0, 3), session))


KINDS: dict[str, Callable[[Random, str], bytes]] = {
    "noise": noise,
    "values": values,
    "cut": cut,
    "out_of_order": out_of_order,
    "replayed": replayed,
}


class Trials:
    """A served world to try frames on. ``begun`` counts the operations that have begun."""

    def __init__(self, folder: Path) -> None:
        self._address = ChannelAddress("unix:t", path=str(folder / "t"))
        self._door = Door(self._address.listening(), "")
        blueprint = read(samples_dir() / "hanoi-2.json")
        host = LocalHost(blueprint, "table")
        self._served = ServedWorld("table", lambda asked: (host, blueprint), False)
        self.told: list[str] = []

    @property
    def begun(self) -> int:
        return self._served.begun

    def close(self) -> None:
        self._served.close()
        self._door.close()
        self._address.forget()

    def tried(self, kind: str, number: int) -> bool:
        """Send what is drawn from a number. Whether the program was sent away for it."""
        chance = Random(f"{kind} {number}")
        end = self._address.connected(5.0)
        with end:
            end.setblocking(True)
            end.settimeout(5.0)
            end.sendall(framed({"n": 1, "ask": "hello", "version": 1}))
            session = self._answer_of(end)["session"]
            opened = {"n": 2, "ask": "open", "session": session, "start": START}
            end.sendall(framed(opened))
            assert self._answer_of(end)["answer"] == "open"
            end.sendall(KINDS[kind](chance, session))
            self.told.clear()
            self._answer()
            self._answer()
        for _ in range(10):
            if self._door.taken:
                self._answer()
        return bool(self.told) and not self._door.taken

    def _answer(self) -> None:
        serve_once(self._door, self._served, lambda told: self.told.append(told["event"]), 0.0)

    def _answer_of(self, end: Any) -> Frame:
        buffer = FrameBuffer(LARGEST)
        while (found := buffer.take()) is None:
            while not select.select([end], [], [], 0)[0]:
                self._answer()
            buffer.add(end.recv(65536))
        return found
