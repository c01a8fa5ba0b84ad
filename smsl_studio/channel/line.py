"""The dispatcher's end of a connection: it asks, and waits for the answer for a limited time.

There is one question at a time. Only ``stop`` does not wait for the answer before it.
"""

from __future__ import annotations

import contextlib
import select
import socket
import time
from collections.abc import Callable

from smsl_studio.channel.fields import LONGEST_SENTENCE, text_of
from smsl_studio.channel.frames import LARGEST, ChannelError, Frame, FrameBuffer, frame_bytes
from smsl_studio.legible import one_line

LOOK = 0.05
"""The interval (s) at which a waiting line checks whether it is still wanted."""

_PIECE = 2**16


class Declined(Exception):  # noqa: N818
    """The world has refused a question, in a sentence. It is otherwise in order."""

    def __init__(self, sentence: str, advice: str = "") -> None:
        super().__init__(sentence)
        self.sentence, self.advice = sentence, advice


class Line:
    """A connection to a world. ``wanted`` is called while the line waits; it may raise."""

    def __init__(self, end: socket.socket, wanted: Callable[[], object]) -> None:
        end.setblocking(False)
        self.session = ""
        self._end = end
        self._wanted = wanted
        self._number = 0
        self._buffer = FrameBuffer(LARGEST)
        self.owed = False
        """Whether the last question has no answer yet."""

    def ask(self, verb: str, limit: float, **said: object) -> Frame:
        """Ask a question, and return the answer.

        ChannelError if the connection is lost, if no answer comes within ``limit`` seconds, or if
        what comes is no answer. Declined if the world refuses.
        """
        self._refuse_unasked()
        until = time.monotonic() + limit
        number = self._send(verb, until, said)
        self.owed = True
        frame = self._frame(until)
        while frame is None:
            self._wanted()
            if time.monotonic() > until:
                raise ChannelError(f"it did not answer for {limit:g} s")
            self._wait(select.POLLIN, until)
            self._read()
            frame = self._buffer.take()
        self.owed = False
        self._check(frame, number, verb)
        return frame

    def stop(self, mode: str, limit: float) -> bool:
        """Send a stop at once, even while an answer is owed. Return whether the world has
        acknowledged it within ``limit`` seconds. What it says before that is not read."""
        until = time.monotonic() + limit
        try:
            number = self._send("stop", until, {"mode": mode})
            while time.monotonic() < until:
                frame = self._buffer.take()
                if frame is None:
                    self._wait(select.POLLIN, until)
                    self._read()
                elif frame.get("n") == number:
                    self._check(frame, number, "stop")
                    return True
        except (ChannelError, Declined):
            return False
        return False

    def close(self) -> None:
        """Say goodbye without waiting, and close the connection."""
        with contextlib.suppress(OSError, ChannelError):
            self._end.send(frame_bytes(self._question("close", {})))
        self._end.close()

    def _question(self, verb: str, said: dict[str, object]) -> Frame:
        self._number += 1
        session = {"session": self.session} if self.session else {}
        return {"n": self._number, "ask": verb, **session, **said}

    def _send(self, verb: str, until: float, said: dict[str, object]) -> int:
        left = memoryview(frame_bytes(self._question(verb, said)))
        while left:
            try:
                left = left[self._end.send(left) :]
            except BlockingIOError:
                if time.monotonic() > until:
                    raise ChannelError("it does not read what is sent") from None
                self._wait(select.POLLOUT, until)
            except OSError as error:
                raise ChannelError(_lost(error)) from None
        return self._number

    def _frame(self, until: float) -> Frame | None:
        """Wait for a quick answer without asking whether it is wanted, as most answers are."""
        self._wait(select.POLLIN, until)
        self._read()
        return self._buffer.take()

    def _wait(self, event: int, until: float) -> None:
        poll = select.poll()
        poll.register(self._end, event)
        poll.poll(max(0.0, min(LOOK, until - time.monotonic())) * 1000)

    def _read(self) -> None:
        try:
            piece = self._end.recv(_PIECE)
        except BlockingIOError:
            return
        except OSError as error:
            raise ChannelError(_lost(error)) from None
        if not piece:
            raise ChannelError("the connection was closed")
        self._buffer.add(piece)

    def _refuse_unasked(self) -> None:
        """Raise ChannelError if something has come that answers no question."""
        with contextlib.suppress(ChannelError):
            self._read()
        if len(self._buffer):
            raise ChannelError("it said something that nobody asked")

    def _check(self, frame: Frame, number: int, verb: str) -> None:
        told = frame.get("n")
        if type(told) is not int or told != number:
            raise ChannelError("it answered another question")
        answer = frame.get("answer")
        if answer == "refused":
            sentence = one_line(text_of(frame, "sentence", LONGEST_SENTENCE))
            raise Declined(sentence, one_line(text_of(frame, "advice", LONGEST_SENTENCE, "")))
        if answer != verb:
            raise ChannelError(f"it answered something else than {verb}")


def _lost(error: OSError) -> str:
    return f"the connection is lost: {error.strerror or error}"
