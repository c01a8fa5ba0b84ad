"""MQTT topics: one for the status of each node, and one for each source of a fact.

::

    smsl/1/<site>/node/<node>/status                               retained: birth and will
    smsl/1/<site>/run/<run>/fact/<sb>/<index>/<source>             never retained

Every name is percent-encoded, except letters, digits, ``_``, ``.``, ``-`` and ``~``. So a name may
contain any character, even ``/``, ``+`` and ``#``. Each name has exactly one spelling.
"""

from __future__ import annotations

from dataclasses import dataclass
from urllib.parse import quote, unquote

START = "smsl/1/"


@dataclass(frozen=True, slots=True)
class StatusTopic:
    """The topic of the status of one node."""

    site: str
    node: str

    def __str__(self) -> str:
        return f"{START}{written(self.site)}/node/{written(self.node)}/status"


@dataclass(frozen=True, slots=True)
class FactTopic:
    """The topic of one source of one fact in one run. ``digit`` counts from 0."""

    site: str
    run: str
    branch: str
    digit: int
    source: str

    def __str__(self) -> str:
        names = written(self.branch), str(self.digit), written(self.source)
        return f"{START}{written(self.site)}/run/{written(self.run)}/fact/{'/'.join(names)}"


def written(name: str) -> str:
    """Encode a name as one level of a topic."""
    return quote(name, safe="", errors="surrogatepass")


def read_topic(topic: str) -> StatusTopic | FactTopic | None:
    """Read a topic. None if it is not a topic of this program."""
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
