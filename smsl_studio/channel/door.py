"""The world's end: it listens, and lets one program in at a time. Nothing that a program sends or
leaves out holds it up for longer than ``PATIENCE``, or fills its memory.

A program that has not shown its token has a small first frame and ``PATIENCE`` seconds to send it.
After that questions must count from 2 without a gap, and repeat the word of the session. So no
frame counts that is doubled, out of order, or of another session.
"""

from __future__ import annotations

import contextlib
import hmac
import secrets
import select
import socket
import time
from dataclasses import dataclass, field
from typing import NamedTuple

from smsl_studio.channel.fields import shown
from smsl_studio.channel.frames import (
    LARGEST,
    LARGEST_HELLO,
    LARGEST_QUESTION,
    VERSION,
    ChannelError,
    Frame,
    FrameBuffer,
    frame_bytes,
)

PATIENCE = 3.0
"""The wall time (s) for a whole frame, for a silence, and for an answer to be taken."""
MOST_WAITING = 8
"""The largest number of programs that have not said hello."""
_PIECE = 2**16


class AskedQuestion(NamedTuple):
    """A question that keeps to the protocol: its number, its verb, and all its fields."""

    number: int
    verb: str
    frame: Frame


@dataclass(eq=False)
class Visitor:
    """A program at the door. ``since`` is when it came, its last whole frame came, or it got its
    last answer (s)."""

    end: socket.socket
    buffer: FrameBuffer = field(default_factory=lambda: FrameBuffer(LARGEST_HELLO))
    since: float = field(default_factory=time.monotonic)
    number: int = 0
    session: str = ""

    def read(self) -> None:
        """Keep what has come. ChannelError if the connection is closed."""
        try:
            piece = self.end.recv(_PIECE)
        except BlockingIOError:
            return
        except OSError as error:
            raise ChannelError(f"the connection is lost: {error.strerror or error}") from None
        if not piece:
            raise ChannelError("the connection was closed")
        self.buffer.add(piece)

    def frame(self) -> Frame | None:
        """Return the next whole frame. ChannelError if it is none, or late."""
        now = time.monotonic()
        found = self.buffer.take()
        if found is not None:
            self.since = now
            return found
        if now - self.since <= PATIENCE:
            return None
        what = "a frame was not whole after" if len(self.buffer) else "it has said nothing for"
        raise ChannelError(f"{what} {PATIENCE:g} s")

    def send(self, frame: Frame) -> None:
        """Send a frame. ChannelError if it is not taken in time."""
        try:
            self.end.settimeout(PATIENCE)
            self.end.sendall(frame_bytes(frame))
            self.end.setblocking(False)
        except OSError as error:
            raise ChannelError(f"it does not take the answer: {error.strerror or error}") from None


class Door:
    """A listening socket, programs that wait, and the one that is inside."""

    def __init__(self, listener: socket.socket, token: str) -> None:
        self.refusals = 0
        """How many programs were sent away."""
        self._listener, self._token = listener, token
        self._waiting: list[Visitor] = []
        self._inside: Visitor | None = None

    @property
    def taken(self) -> bool:
        """Whether a program is inside."""
        return self._inside is not None

    def next(self, wait: float) -> AskedQuestion | None:
        """Return the next question of the program inside, or None after ``wait`` seconds. Its
        first one is ``hello``. ChannelError if the program is lost; then the door is free."""
        self._look(wait)
        question = self._question()
        return question if question is not None else self._hello()

    def answer(self, question: AskedQuestion, frame: Frame) -> None:
        """Answer a question. ChannelError if the program does not take the answer."""
        assert self._inside is not None
        try:
            self._inside.send({"n": question.number, **frame})
        except ChannelError:
            self.leave()
            raise
        # It could say nothing while it waited for the answer.
        self._inside.since = time.monotonic()

    def leave(self) -> None:
        """Close the connection of the program inside."""
        if self._inside is not None:
            self._inside.end.close()
        self._inside = None

    def close(self) -> None:
        """Close everything."""
        self.leave()
        for visitor in self._waiting:
            visitor.end.close()
        self._waiting = []
        self._listener.close()

    def _look(self, wait: float) -> None:
        """Wait for bytes, read those of everybody once, and let new programs wait."""
        poll = select.poll()
        ends = {self._listener.fileno(): self._listener}
        visitors = {one.end.fileno(): one for one in self._everybody()}
        for number in (*ends, *visitors):
            poll.register(number, select.POLLIN)
        inside = self._inside
        ready = {number for number, _ in poll.poll(self._patience(inside, wait) * 1000)}
        if self._listener.fileno() in ready:
            self._accept()
        for number in ready & visitors.keys():
            visitor = visitors[number]
            if visitor is not inside:
                self._take(visitor)
        if inside is not None and inside.end.fileno() in ready and not _full(inside):
            try:
                inside.read()
            except ChannelError:
                self.leave()
                raise

    def _patience(self, inside: Visitor | None, wait: float) -> float:
        """Return how long to wait: not at all if a frame may be whole already."""
        return 0.0 if inside is not None and len(inside.buffer) else wait

    def _everybody(self) -> list[Visitor]:
        return [*self._waiting, *([self._inside] if self._inside else [])]

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            end, _ = self._listener.accept()
            end.setblocking(False)
            visitor = Visitor(end)
            if len(self._waiting) >= MOST_WAITING:
                self._send_away(visitor, "too many programs wait")
            else:
                self._waiting.append(visitor)

    def _take(self, visitor: Visitor) -> None:
        try:
            visitor.read()
        except ChannelError:
            self._send_away(visitor, "")

    def _hello(self) -> AskedQuestion | None:
        """Look at everybody who waits. Return the hello of the first one who may come in."""
        for visitor in list(self._waiting):
            try:
                frame = visitor.frame()
            except ChannelError as error:
                self._send_away(visitor, str(error))
                continue
            if frame is None:
                continue
            refused = self._refused(frame)
            if refused:
                self._send_away(visitor, refused)
                continue
            self._waiting.remove(visitor)
            visitor.number, visitor.session = 1, secrets.token_hex(8)
            visitor.buffer.largest = LARGEST
            self._inside = visitor
            return AskedQuestion(1, "hello", frame)
        return None

    def _refused(self, frame: Frame) -> str:
        """Return why a program may not come in, from its first frame. Empty if it may."""
        number, version, token = frame.get("n"), frame.get("version"), frame.get("token", "")
        if frame.get("ask") != "hello" or type(number) is not int or number != 1:
            return "the first question must be hello, with the number 1"
        if type(version) is not int or version != VERSION:
            return f"version is {shown(version)}, not {VERSION}"
        if not isinstance(token, str) or not _equal(token, self._token):
            return "the token is not the right one"
        return "another program is connected" if self._inside is not None else ""

    @property
    def session(self) -> str:
        """The word that each question of the program inside must repeat."""
        return self._inside.session if self._inside else ""

    def _send_away(self, visitor: Visitor, why: str) -> None:
        self.refusals += 1
        with contextlib.suppress(OSError, ChannelError):
            if why:
                visitor.end.send(frame_bytes({"n": 1, "answer": "refused", "sentence": why}))
        visitor.end.close()
        if visitor in self._waiting:
            self._waiting.remove(visitor)

    def _question(self) -> AskedQuestion | None:
        inside = self._inside
        if inside is None:
            return None
        try:
            frame = inside.frame()
            if frame is None:
                return None
            number, verb = frame.get("n"), frame.get("ask")
            if type(number) is not int or number != inside.number + 1:
                raise ChannelError(f"question {shown(number)} came, not {inside.number + 1}")
            if not isinstance(verb, str) or frame.get("session") != inside.session:
                raise ChannelError("a question is not of this session")
        except ChannelError:
            self.leave()
            raise
        inside.number = number
        inside.buffer.largest = LARGEST_QUESTION
        return AskedQuestion(number, verb, frame)


def _full(visitor: Visitor) -> bool:
    """Whether more is kept of a program than its largest frame, so that nothing more is read."""
    return len(visitor.buffer) > visitor.buffer.largest + 4


def _equal(token: str, right: str) -> bool:
    return hmac.compare_digest(token.encode("utf-8", "replace"), right.encode())
