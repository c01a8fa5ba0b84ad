"""Programs that have a table world and listen at a socket: honest ones, and others."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.channel.address import ChannelAddress
from smsl_studio.channel.door import AskedQuestion
from smsl_studio.channel.frames import LARGEST, Frame, FrameBuffer, frame_bytes
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.front.served_worlds import WorldBuilder
from smsl_studio.host.asked_program import ProgramTerms
from smsl_studio.host.program_host import ProgramHost
from smsl_studio.host.served_world import ServedWorld
from smsl_studio.runlog.events import Event, Held, RunFinished

Lie = Callable[[str, Frame], bytes | None]
"""What a program sends in the place of an honest answer to a verb. None means nothing."""


def honest(verb: str, answer: Frame) -> bytes | None:
    """The answer as it is."""
    return frame_bytes(answer)


class Program:
    """A program with a table world. It answers as ``lie`` says. ``heard`` are the verbs that were
    asked."""

    def __init__(self, blueprint: Blueprint, listener: socket.socket, lie: Lie) -> None:
        builder = WorldBuilder("table")
        builder.own = blueprint
        self.heard: list[str] = []
        self._served = ServedWorld("table", builder.build, False)
        self._lie = lie
        self._listener = listener
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Wait until the program has ended."""
        self._listener.close()
        self._thread.join()

    def _serve(self) -> None:
        try:
            self._listener.setblocking(True)
            end, _ = self._listener.accept()
        except OSError:
            return
        with end:
            self._talk(end)

    def _talk(self, end: socket.socket) -> None:
        buffer = FrameBuffer(LARGEST)
        while piece := _received(end):
            buffer.add(piece)
            while (frame := buffer.take()) is not None:
                self.heard.append(frame["ask"])
                if frame["ask"] == "close":
                    return
                said = self._lie(frame["ask"], self._answer(frame))
                try:
                    if said == b"":
                        return
                    if said is not None:
                        end.sendall(said)
                except OSError:
                    return

    def _answer(self, frame: Frame) -> Frame:
        if frame["ask"] == "hello":
            return {"n": frame["n"], **self._served.card("session")}
        question = AskedQuestion(frame["n"], frame["ask"], frame)
        return {"n": frame["n"], **self._served.answer(question)}


def _received(end: socket.socket) -> bytes:
    try:
        return end.recv(65536)
    except OSError:
        return b""


@contextmanager
def program(blueprint: Blueprint, folder: Path, lie: Lie = honest) -> Iterator[Program]:
    """A program that listens in a folder, in a thread of its own."""
    address = ChannelAddress("unix:p", path=str(folder / "p"))
    running = Program(blueprint, address.listening(), lie)
    try:
        yield running
    finally:
        running.end()
        address.forget()


def driven(blueprint: Blueprint, folder: Path, goal: str, **limits: Any) -> list[Event]:
    """The events of a run in the program that listens in a folder."""
    address = ChannelAddress("unix:p", path=str(folder / "p"))
    terms = ProgramTerms(partial(address.connected, 2.0), "unix:p", **limits)
    host = ProgramHost(blueprint, "remote", 0, terms)
    dispatcher = Dispatcher(blueprint, host, RunTerms(goals=(blueprint.resolve(goal),)))
    events = list(dispatcher.open())
    try:
        while not dispatcher.finished:
            events += dispatcher.tick()
    finally:
        dispatcher.close()
    return events


def end_of(events: list[Event]) -> tuple[str, str]:
    """How a run ended, and the reason of its last hold."""
    finished, holds = events[-1], [one for one in events if isinstance(one, Held)]
    assert isinstance(finished, RunFinished)
    return finished.reason, holds[-1].reason if holds else ""
