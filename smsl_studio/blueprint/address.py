"""Addresses: they name an SB, a state or an operation in every selection, finding, highlight and
log.
"""

from __future__ import annotations

from dataclasses import dataclass


def escape(name: str) -> str:
    """Return a name as one part of an address."""
    if "~" in name or "/" in name:
        return name.replace("~", "~0").replace("/", "~1")
    return name


def _unescape(part: str) -> str:
    return part.replace("~1", "/").replace("~0", "~")


@dataclass(frozen=True, slots=True, order=True)
class Address:
    """``SB``, ``SB/State`` or ``SB/State/Operation``.

    A ``/`` inside a name is written ``~1`` and a ``~`` as ``~0`` (as in RFC 6901), so that ``str``
    and ``split`` are inverse for any names. The element need not exist: see ``Blueprint.resolve``.
    """

    branch: str
    state: str = ""
    operation: str = ""

    def __str__(self) -> str:
        path = self.path
        text = "/".join(path)
        if "~" not in text and text.count("/") == len(path) - 1:
            return text
        return "/".join(map(escape, path))

    @property
    def path(self) -> tuple[str, ...]:
        """The names in this address, outermost first."""
        if self.operation:
            return (self.branch, self.state, self.operation)
        return (self.branch, self.state) if self.state else (self.branch,)

    @property
    def parent(self) -> Address | None:
        """The address one level up, or None for a State Branch."""
        if self.operation:
            return Address(self.branch, self.state)
        return Address(self.branch) if self.state else None

    @staticmethod
    def split(text: str) -> tuple[str, ...]:
        """Return the names in a written address."""
        return tuple(_unescape(part) for part in text.split("/"))

    @staticmethod
    def read(text: str) -> Address | None:
        """Return the address in a text from outside, such as a log. None if it is no address."""
        names = Address.split(text)
        return Address(*names) if len(names) <= 3 and all(names) else None


def state_text(branch: str, state: str) -> str:
    """Return the address of a state as text."""
    return f"{escape(branch)}/{escape(state)}"


def fact_text(branch: str, digit: int) -> str:
    """Return a fact as ``requires`` and ``_hazards`` write it: ``SB/digit``, counted from 0."""
    return f"{escape(branch)}/{digit}"


def split_fact(text: str) -> tuple[str, int] | None:
    """Return the SB and the digit of a written fact, or None if the text is no fact."""
    branch, slash, digit = text.rpartition("/")
    if not (slash and branch and digit.isascii() and digit.isdecimal() and len(digit) < 7):
        return None
    return _unescape(branch), int(digit)


def note_key(operation: str, state: str = "") -> str:
    """Return a key of ``_operations``: the operation's name, or with a state
    ``State/Operation``.
    """
    return f"{escape(state)}/{escape(operation)}" if state else escape(operation)
