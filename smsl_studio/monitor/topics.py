"""MQTT topics: where a node says how it is, and where it says what a fact is.

::

    smsl/1/<site>/node/<node>/status                               retained: birth and will
    smsl/1/<site>/run/<run>/fact/<sb>/<index>/<source>             never retained

Every name is percent-encoded, all but letters, digits, ``_``, ``.``, ``-`` and ``~``, so that any
character may stand in one, ``/``, ``+`` and ``#`` too. A name has one spelling only.
"""

from __future__ import annotations

from dataclasses import dataclass
from urllib.parse import quote, unquote

START = "smsl/1/"


@dataclass(frozen=True, slots=True)
class StatusTopic:
    """Where a node of a site tells that it lives."""

    site: str
    node: str

    def __str__(self) -> str:
        return f"{START}{written(self.site)}/node/{written(self.node)}/status"


@dataclass(frozen=True, slots=True)
class FactTopic:
    """Where one source tells one fact of one run; ``digit`` counts from 0."""

    site: str
    run: str
    branch: str
    digit: int
    source: str

    def __str__(self) -> str:
        names = written(self.branch), str(self.digit), written(self.source)
        return f"{START}{written(self.site)}/run/{written(self.run)}/fact/{'/'.join(names)}"


def written(name: str) -> str:
    """A name as one level of a topic."""
    return quote(name, safe="", errors="surrogatepass")


def read_topic(topic: str) -> StatusTopic | FactTopic | None:
    """What a topic is about; None where it is none of ours."""
    if not topic.startswith(START):
        return None
    match topic.removeprefix(START).split("/"):
        case [site, "node", node, "status"]:
            names = _names(site, node)
            return StatusTopic(*names) if names else None
        case [site, "run", run, "fact", branch, index, source]:
            names = _names(site, run, branch, source)
            digit = _digit(index)
            if names is None or digit is None:
                return None
            return FactTopic(names[0], names[1], names[2], digit, names[3])
    return None


def _names(*levels: str) -> tuple[str, ...] | None:
    found = []
    for level in levels:
        try:
            name = unquote(level, errors="surrogatepass")
        except UnicodeDecodeError:
            return None
        if not name or written(name) != level:
            return None
        found.append(name)
    return tuple(found)


def _digit(level: str) -> int | None:
    plain = level.isascii() and level.isdecimal() and len(level) < 7
    return int(level) if plain and str(int(level)) == level else None
