"""What a library keeps of an operation: its code, its names, and when it can be used."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from smsl_studio.library.pattern import Pattern
from smsl_studio.library.signature import Signature


@dataclass(frozen=True, slots=True)
class Availability:
    """Whether an operation can be used now. Both functions are called as the operation's own is.

    ``why_not`` returns why it cannot be used, as a text that follows "not available:", or the empty
    text. Routes avoid the operation then, and it does not begin. ``premise`` makes ``why_not``
    agree in a world that was just arranged, without changing a fact, so that the operation can be
    tried alone.
    """

    why_not: Callable[..., str]
    premise: Callable[..., None] | None = None


@dataclass(frozen=True, slots=True)
class OperationEntry:
    """A generator function and the pattern of its operation names.

    A pattern of None means that the function is used only where a binding names it. ``name`` is
    ``plugin.function``. ``timeout`` is in simulated seconds.
    """

    function: Callable[..., Any]
    name: str
    pattern: Pattern | None
    signature: Signature
    stop: str
    timeout: float
    resumes: bool = True
    touches: tuple[Pattern, ...] = ()
    available: Availability | None = None
    recovery: bool = False
    code: str = ""
    """The digest of a generated function (see ``generated_functions``). Empty for all others."""

    def texts(self, branch: str, operation: str) -> dict[str, str] | None:
        """Return the parameters that the pattern finds in the name of an operation, None if it does
        not match. A pattern ``SB/Operation`` matches in this SB only."""
        if self.pattern is None:
            return None
        whole = f"{branch}/{operation}" if "/" in self.pattern.text else operation
        return self.pattern.match(whole)
