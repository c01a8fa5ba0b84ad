"""An automatic supervisor as it is asked for: ``NAME`` or ``NAME:key=value,key=value``."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.errors import UsageError

LONGEST = 2_000
"""The largest length of the text, in characters."""
MOST = 8
"""The largest number of supervisors of one run."""


@dataclass(frozen=True, slots=True)
class AskedAgent:
    """A name and its options as texts. ``text`` is what was written, for the record."""

    text: str
    name: str
    options: tuple[tuple[str, str], ...]


def asked_agent(text: str) -> AskedAgent:
    """Read ``NAME:key=value,...``. UsageError if the text has another form."""
    form = "Write it as NAME or NAME:key=value,key=value."
    if not text or len(text) > LONGEST or not text.isprintable():
        raise UsageError(f"the supervisor {text[:60]!r} is no name", advice=form)
    name, colon, rest = text.partition(":")
    if not name.isidentifier():
        raise UsageError(f"the supervisor {name!r} is no name", advice=form)
    options: dict[str, str] = {}
    for part in rest.split(",") if colon else ():
        key, equals, value = part.partition("=")
        if not (equals and key.isidentifier()):
            raise UsageError(f"the option {part!r} of {name} has no name and value", advice=form)
        if key in options:
            raise UsageError(f"the option {key!r} of {name} stands twice", advice="Leave one out.")
        options[key] = value
    return AskedAgent(text, name, tuple(options.items()))


def asked_agents(texts: tuple[str, ...]) -> tuple[AskedAgent, ...]:
    """Read several. UsageError if one has another form, or if there are too many."""
    if len(texts) > MOST:
        raise UsageError(f"{len(texts)} supervisors are more than {MOST}")
    return tuple(map(asked_agent, texts))
