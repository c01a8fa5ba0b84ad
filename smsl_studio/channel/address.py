"""The address of a world that is somewhere else, and the token that opens it.

An address is ``unix:PATH`` or ``HOST:PORT``. The host must be this computer (127.0.0.1, ``[::1]``
or localhost), because the protocol has no encryption.
"""

from __future__ import annotations

import os
import socket
import stat
from dataclasses import dataclass
from pathlib import Path

from smsl_studio.errors import UsageError
from smsl_studio.smsl.inputs import read_ordinary

LONGEST_PATH = 100
"""The largest length of the path of a Unix socket, in bytes. Systems allow little more."""
SHORTEST_TOKEN, LONGEST_TOKEN = 16, 200
"""The least and the largest length of a token, in characters."""
_LOOPBACK = {"127.0.0.1": "127.0.0.1", "localhost": "127.0.0.1", "[::1]": "::1"}
_ADVICE = "Write unix:PATH, or 127.0.0.1:PORT."


@dataclass(frozen=True)
class ChannelAddress:
    """Where a world listens: the path of a Unix socket, or a port of this computer."""

    text: str
    path: str = ""
    host: str = ""
    port: int = 0

    @property
    def needs_token(self) -> bool:
        """Whether every user of this computer can reach the address. A Unix socket has rights."""
        return not self.path

    def connected(self, limit: float) -> socket.socket:
        """Connect within ``limit`` seconds. OSError if nobody listens."""
        family, place = self._place()
        end = socket.socket(family, socket.SOCK_STREAM)
        try:
            end.settimeout(limit)
            end.connect(place)
            end.setblocking(False)
            if not self.path:
                end.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        except BaseException:
            end.close()
            raise
        return end

    def listening(self) -> socket.socket:
        """Listen. A Unix socket is for this user alone. OSError if that is not possible."""
        family, place = self._place()
        if self.path:
            self._clear()
        end = socket.socket(family, socket.SOCK_STREAM)
        before = os.umask(0o177)
        try:
            if not self.path:
                end.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            end.bind(place)
            end.listen(16)
            end.setblocking(False)
        except BaseException:
            end.close()
            raise
        finally:
            os.umask(before)
        return end

    def forget(self) -> None:
        """Remove the file of a Unix socket."""
        if self.path:
            Path(self.path).unlink(missing_ok=True)

    def _place(self) -> tuple[socket.AddressFamily, str | tuple[str, int]]:
        if self.path:
            return socket.AF_UNIX, self.path
        family = socket.AF_INET6 if ":" in self.host else socket.AF_INET
        return family, (self.host, self.port)

    def _clear(self) -> None:
        """Remove the socket that a program has left behind which has ended."""
        try:
            kind = os.lstat(self.path).st_mode
        except FileNotFoundError:
            return
        if not stat.S_ISSOCK(kind):
            return
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as probe:
            try:
                probe.connect(self.path)
            except ConnectionRefusedError:
                Path(self.path).unlink(missing_ok=True)


def read_address(text: str) -> ChannelAddress:
    """Return a written address. UsageError if it is none, or beyond this computer."""
    if text.startswith("unix:"):
        path = text.removeprefix("unix:")
        if not path or "\0" in path or len(os.fsencode(path)) > LONGEST_PATH:
            words = f"{text[:120]!r} names no socket: a path has 1 to {LONGEST_PATH} bytes"
            raise UsageError(words, advice=_ADVICE)
        return ChannelAddress(text, path=path)
    host, colon, port = text.rpartition(":")
    number = int(port) if port.isascii() and port.isdecimal() and len(port) < 6 else 0
    if not colon or not host or not 0 < number < 65536:
        raise UsageError(f"{text[:120]!r} is no address", advice=_ADVICE)
    if host not in _LOOPBACK:
        words = f"{text[:120]!r} is beyond this computer, and the connection is not encrypted"
        raise UsageError(words, advice=f"{_ADVICE} A tunnel (ssh -L) brings it here.")
    return ChannelAddress(text, host=_LOOPBACK[host], port=number)


def read_token(address: ChannelAddress, file: str | None) -> str:
    """Return the token in a file, empty if none is named. UsageError if the address needs one, or
    if the file has none or others can read it."""
    if not file:
        if address.needs_token:
            advice = "Write one into a file that only you can read, and say --token-file FILE."
            raise UsageError(f"{address.text} needs a token", advice=advice)
        return ""
    try:
        token = read_ordinary(Path(file), 4096).raw.decode("ascii").strip()
        mode = Path(file).stat().st_mode
    except (OSError, ValueError) as error:
        words = getattr(error, "strerror", None) or error
        raise UsageError(f"{file}: the token cannot be read: {words}") from None
    if mode & 0o077:
        raise UsageError(f"{file} can be read by others", advice=f"Say: chmod 600 {file}")
    if not SHORTEST_TOKEN <= len(token) <= LONGEST_TOKEN or not token.isprintable():
        words = f"{file} has no token: one line of {SHORTEST_TOKEN} to {LONGEST_TOKEN} characters"
        raise UsageError(words, advice="Say: openssl rand -hex 16 > FILE")
    return token
