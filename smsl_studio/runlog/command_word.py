"""What the record of a run says of one command: in which words, and what must follow it.

``dispatch`` has the table of all commands; whoever reads records below it is handed its rows as
these values.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True, eq=False)
class CommandWord:
    """A command as it stands in a record.

    ``refused`` has the run states that refuse it whatever is said with it, each with the reason
    (``{by}`` is who has taken over). ``sentence`` is what an account says of it; ``sentences`` are
    those that hang on its value. ``{address}`` and ``{value}`` are what was said with it.
    ``owes`` is the event that must follow where it was carried out, ``explains`` are the events
    that are told in the name of whoever commanded it.
    """

    word: str = field(kw_only=False)
    refused: Mapping[str, str] = field(default_factory=dict)
    sentence: str = ""
    sentences: Mapping[str, str] = field(default_factory=dict)
    owes: str = ""
    explains: tuple[str, ...] = ()

    def why_refused(self, phase: str, by: str) -> str:
        """Why a run state refuses it; ``by`` has taken over. Empty where the state does not."""
        return self.refused.get(phase, "").format(by=by[:1].upper() + by[1:])

    def told(self, address: str, value: str) -> str:
        """What an account says of it; empty where it has no words for such a value."""
        return self.sentences.get(value, self.sentence).format(address=address, value=value)
