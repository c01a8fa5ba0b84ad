"""A program that is asked in lockstep: its connection, its limits, and its loss.

An answer that is late, that is no answer, or that cannot be true ends the connection, with a stop
first. The error says whether the program acknowledged the stop. Every later question raises the
same error. Times are wall time.
"""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from types import TracebackType

from smsl_studio.channel.frames import VERSION, ChannelError, Frame
from smsl_studio.channel.line import Declined, Line
from smsl_studio.channel.offer import WorldCard, read_card
from smsl_studio.errors import HostError
from smsl_studio.stop import BrokenOff, StopListener, Stopped, heed

PULSE = 1.0
"""The time (s) after which a program that was asked nothing gets a pulse."""
_QUICK = 2
"""After a stop, how often a question looks whether its answer has come."""


@dataclass(frozen=True, slots=True)
class ProgramTerms:
    """How a program is reached, and its limits in seconds.

    ``connect`` makes the connection; OSError if nobody listens. ``address`` is for people.
    ``barred`` is the code of the refusal if the program is hardware; empty: the run is approved.
    """

    connect: Callable[[], socket.socket]
    address: str
    token: str = ""
    barred: str = "policy_unmet"
    answer_limit: float = 5.0
    open_limit: float = 60.0
    stop_limit: float = 0.5


class AskedProgram:
    """A program at the other end of a connection. Any thread may call ``close``.

    ``running`` is the operation that the program carries out, empty if it does none.
    """

    def __init__(self, terms: ProgramTerms) -> None:
        self.running = ""
        self.terms = terms
        self._line: Line | None = None
        self._gone: HostError | None = None
        self._using = threading.RLock()
        self._over = threading.Event()
        self._spoke = time.monotonic()
        self._late: StopListener | None = None

    def connect(self) -> WorldCard:
        """Connect, and return what the program says about itself. HostError if nobody answers, or
        if the program refuses."""
        self.check()
        terms = self.terms
        try:
            end = terms.connect()
        except OSError as error:
            words = f"nothing answers at {terms.address}: {error.strerror or error}"
            raise HostError(words, advice="Start the program first.") from None
        line = self._line = Line(end, self._wanted)
        try:
            said = {"version": VERSION, "token": terms.token}
            card = read_card(line.ask("hello", terms.answer_limit, **said))
        except Declined as error:
            raise self._unmet(f"refuses the connection: {error.sentence}", error.advice) from None
        except ChannelError as error:
            advice = "Look whether it is the right program, and whether it serves another one."
            raise self._unmet(f"does not say hello: {error}", advice) from None
        line.session = card.session
        threading.Thread(target=self._beat, daemon=True).start()
        return card

    def ask(self, verb: str, limit: float, **said: object) -> Frame:
        """Ask, and return the answer. Declined if the program refuses, HostError if it is lost."""
        with self._using:
            line, self._late = self._standing(), None
            try:
                frame = line.ask(verb, limit, **said)
            except ChannelError as error:
                raise self.lost(f"{error}{self._doing}") from None
            self._spoke = time.monotonic()
            return frame

    def carried(self, verb: str, **said: object) -> Frame:
        """Ask where a refusal is a loss: what was offered must be carried out."""
        try:
            return self.ask(verb, self.terms.answer_limit, **said)
        except Declined as error:
            raise self.lost(f"it refused {verb}{self._doing}: {error.sentence}") from None

    def stop(self, mode: str) -> None:
        """Stop what moves, at once, even while an answer is owed. HostError if the program does
        not acknowledge it."""
        with self._using:
            line = self._standing()
            owed = line.owed
            if not line.stop(mode, self.terms.stop_limit):
                why = f"a stop had no answer within {self.terms.stop_limit:g} s{self._doing}"
                raise self.lost(why, stopped=False)
            self._spoke, self.running = time.monotonic(), ""
            if owed:
                # What it would have said is lost, so its time is not known any more.
                raise self.lost("it was stopped before it had answered", stopped=True)

    def lost(self, why: str, stopped: bool | None = None) -> HostError:
        """Stop the program and end the connection. Return the error to raise now and later.

        ``stopped`` says whether a stop was acknowledged. None: one is sent now.
        """
        with self._using:
            if self._gone is not None:
                return HostError(self._gone.sentence, advice=self._gone.advice)
            if stopped is None and self._line is not None:
                stopped = self._line.stop("abort", self.terms.stop_limit)
            told = (
                "It acknowledged a stop"
                if stopped
                else "It did not acknowledge a stop, so it may still move"
            )
            words = f"the program at {self.terms.address} is lost: {why}. {told}"
            self._gone = HostError(words, advice="Look at it, then start a new run.")
            self._end()
            return self._gone

    def checking(self) -> Checking:
        """Return a context in which a ChannelError is the loss of the program."""
        return Checking(lambda words: self.lost(f"what it says cannot be{self._doing}: {words}"))

    def check(self) -> None:
        """Raise HostError if the program is lost, as far as is known."""
        if self._gone is not None:
            raise HostError(self._gone.sentence, advice=self._gone.advice)

    def close(self) -> None:
        """End the connection, so that the program brakes. A second call does nothing."""
        self._over.set()
        with self._using:
            self._gone = self._gone or HostError("the host is closed")
            self._end()

    @property
    def _doing(self) -> str:
        return f" in the middle of {self.running}" if self.running else ""

    def _unmet(self, why: str, advice: str) -> HostError:
        """End a connection on which nothing has begun. Return the error."""
        self._gone = HostError(f"the program at {self.terms.address} {why}", advice=advice)
        self._end()
        return self._gone

    def _standing(self) -> Line:
        self.check()
        if self._line is None:
            raise HostError("the host is not open")
        return self._line

    def _end(self) -> None:
        self._over.set()
        if self._line is not None:
            self._line.close()
        self._line = None

    def _wanted(self) -> None:
        """Raise if nobody waits for the answer any more. A quick answer is waited for."""
        if self._over.is_set():
            raise ChannelError("the run is closed")
        if self._late is not None:
            self._late.heed()
            return
        try:
            heed()
        except BrokenOff:
            raise
        except Stopped:
            self._late = StopListener(_QUICK)

    def _beat(self) -> None:
        """Send a pulse if nothing else was said for a while, until the connection ends."""
        while not self._over.wait(PULSE / 4):
            if time.monotonic() - self._spoke < PULSE or not self._using.acquire(blocking=False):
                continue
            try:
                self.carried("pulse")
            except HostError:
                return
            finally:
                self._using.release()


class Checking:
    """Turns what is wrong with an answer into the loss of the program."""

    __slots__ = ("_lost",)

    def __init__(self, lost: Callable[[str], HostError]) -> None:
        self._lost = lost

    def __enter__(self) -> None: ...

    def __exit__(
        self, kind: object, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if isinstance(error, ChannelError):
            raise self._lost(str(error)) from None
