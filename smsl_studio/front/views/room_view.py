"""The room of a run: its nodes, persons and facts, in words that the page Room shows.

It is computed from the site file, the run and what was heard. It asks nobody and changes nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.address import fact_text, split_fact
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.predicates.shown import shown_predicate
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.sites.site_file import Site, SiteNode, SitePerson
from smsl_studio.monitor.bus import SourceKey
from smsl_studio.monitor.facts import SourceState
from smsl_studio.monitor.message import GONE
from smsl_studio.monitor.nodes import FROZEN, NodeState
from smsl_studio.monitor.reception import RemoteView

FRESH, STALE, SILENT, CONTESTED = "fresh", "stale", "silent", "two speakers"
"""The standings of a node. A stale node has said something within ``LONG`` seconds."""
LONG = 5.0


@dataclass(frozen=True)
class NodeTag:
    """A node as it stands now: its standing, the age (s) of its newest sample, and the facts that
    it feeds, as ``SB/digit``. ``reads`` has each of its sources with what it reads. ``site`` has
    its place; None if the site file does not know it."""

    name: str
    title: str
    kind: str
    standing: str
    age: float | None
    boots: int
    facts: tuple[str, ...]
    sources: tuple[SourceState, ...]
    reads: tuple[tuple[str, str], ...]
    site: SiteNode | None = None

    @property
    def words(self) -> str:
        """The standing with its age, such as ``silent, 12.6 s``; a fresh one is its age."""
        if self.standing == CONTESTED:
            return CONTESTED
        said = "never heard" if self.age is None else age_words(self.age)
        return said if self.standing == FRESH else f"{self.standing}, {said}"


@dataclass(frozen=True)
class PersonMark:
    """A person on the plan, by role. None means that it is not known."""

    title: str
    site: SitePerson
    here: bool | None
    sterile: bool | None

    @property
    def words(self) -> str:
        """What is known of the person."""
        if self.here is None or (self.here and self.sterile is None and self.site.sterile):
            return "not known"
        return "not here" if not self.here else "sterile" if self.sterile else "not sterile"


@dataclass(frozen=True)
class RoomFact:
    """A fact that nodes tell: its value, when it holds, on which nodes it rests, and who needs it.

    ``value`` is None if it is unknown, and then ``reason`` says why.
    """

    key: str
    name: str
    value: str | None
    reason: str
    holds_if: str
    predicates: tuple[tuple[str, str], ...]
    nodes: tuple[str, ...]
    rests_on: str
    age: float
    needed_by: tuple[str, ...]
    sources: tuple[str, ...] = ()
    """What its predicates read, by name."""

    @property
    def held_back(self) -> bool:
        """Whether operations wait because the fact is unknown."""
        return self.value is None and bool(self.needed_by)


@dataclass(frozen=True)
class RoomView:
    """All that the page shows of a room."""

    secure: bool
    broker: str
    lost: float | None
    nodes: tuple[NodeTag, ...]
    persons: tuple[PersonMark, ...]
    facts: tuple[RoomFact, ...]
    refused: tuple[str, ...] = ()

    def of(self, node: NodeTag | None) -> tuple[RoomFact, ...]:
        """Return the facts that a node feeds."""
        return tuple(one for one in self.facts if node is not None and one.key in node.facts)

    @property
    def silent(self) -> int:
        """How many nodes are silent."""
        return sum(one.standing == SILENT for one in self.nodes)

    def node(self, name: str) -> NodeTag | None:
        """Return a node by its name, or None."""
        return next((one for one in self.nodes if one.name == name), None)


def room_view(
    blueprint: Blueprint, status: DispatchStatus, remote: RemoteView, site: Site | None
) -> RoomView:
    """Return the room at this moment. Without a ``site`` it has the nodes that were heard."""
    sources = {(*one.fact, one.said.source): one for one in status.sources}
    heard = {one.name: one for one in remote.nodes}
    if site is not None:
        tags = [
            _tag(name, node, heard.get(name), sources, blueprint)
            for name, node in site.nodes.items()
        ]
        persons = [_person(one, sources) for one in site.persons.values()]
    else:
        tags, persons = [_stranger(one, sources, blueprint) for one in remote.nodes], []
    return RoomView(
        remote.secure,
        remote.broker,
        remote.lost,
        tuple(tags),
        tuple(persons),
        tuple(_facts(blueprint, status, tags)),
        tuple(f"{one.count:,} {one.kind}: {one.example}" for one in remote.received.refusals),
    )


def age_words(age: float) -> str:
    """An age in words: ``12 ms``, ``1.4 s``, ``3 min``."""
    if age < 1:
        return f"{round(age * 1000)} ms"
    return f"{age:.1f} s" if age < 100 else f"{round(age / 60)} min"


def _tag(
    name: str,
    node: SiteNode,
    heard: NodeState | None,
    sources: Mapping[SourceKey, SourceState],
    blueprint: Blueprint,
) -> NodeTag:
    own = tuple(sources[key] for key in node.sources if key in sources)
    facts = tuple(dict.fromkeys(fact_text(*key[:2]) for key in node.sources))
    age = heard.heard if heard is not None else None
    boots = heard.boots if heard is not None else 0
    standing = _standing(heard, own)
    reads = tuple(_reads(one, blueprint) for one in own)
    return NodeTag(name, node.title, node.kind, standing, age, boots, facts, own, reads, node)


def _stranger(
    heard: NodeState, sources: Mapping[SourceKey, SourceState], blueprint: Blueprint
) -> NodeTag:
    spoken = [text.rpartition(" ") for text in heard.speaks]
    keys = [(*fact, name) for text, _, name in spoken if (fact := split_fact(text)) is not None]
    own = tuple(sources[key] for key in keys if key in sources)
    facts = tuple(dict.fromkeys(text for text, _, _ in spoken))
    standing = _standing(heard, own)
    reads = tuple(_reads(one, blueprint) for one in own)
    return NodeTag(
        heard.name, heard.name, "device", standing, heard.heard, heard.boots, facts, own, reads
    )


def _reads(source: SourceState, blueprint: Blueprint) -> tuple[str, str]:
    """A source and what it reads, with its unit: ``tag_pointer of POINTER/0`` and ``0.2 m``."""
    said, (branch, digit) = source.said, source.fact
    name = f"{said.source} of {fact_text(branch, digit)}"
    if said.value is None:
        return name, f"? {said.reason}"
    sense = blueprint[branch].notes.senses.get(digit) if branch in blueprint.branches else None
    unit = sense.units.get(said.source) if sense is not None else None
    try:
        words = f"{float(said.value):.4g}"
    except ValueError:
        return name, said.value
    return name, words if unit is None or unit.text == "1" else f"{words} {unit.text}"


def _standing(heard: NodeState | None, own: Sequence[SourceState]) -> str:
    if any(one.said.contested for one in own):
        return CONTESTED
    if heard is None or heard.heard is None or heard.heard > LONG:
        return SILENT
    return STALE if heard.state in (FROZEN, GONE) else FRESH


def _person(person: SitePerson, sources: Mapping[SourceKey, SourceState]) -> PersonMark:
    here = _counts(person.here, person.least, sources)
    sterile = _counts(person.sterile, person.least_sterile, sources)
    return PersonMark(person.title, person, here, sterile)


def _counts(source: str, least: int, sources: Mapping[SourceKey, SourceState]) -> bool | None:
    """Whether a source counts at least so many persons; None if that is not known."""
    text, _, name = source.rpartition(" ")
    fact = split_fact(text)
    found = sources.get((*fact, name)) if fact is not None else None
    if found is None or found.said.value is None:
        return None
    try:
        return float(found.said.value) >= least
    except ValueError:
        return None


def _facts(
    blueprint: Blueprint, status: DispatchStatus, tags: Sequence[NodeTag]
) -> Iterator[RoomFact]:
    feeds: dict[str, list[NodeTag]] = {}
    for tag in tags:
        for key in tag.facts:
            feeds.setdefault(key, []).append(tag)
    needed = _needs(blueprint)
    for key, nodes in feeds.items():
        fact = split_fact(key)
        if fact is None or fact[0] not in blueprint.branches:
            continue
        reading = status.scene.readings.get(fact)
        if reading is None:
            continue
        branch = blueprint[fact[0]]
        sense = branch.notes.senses.get(fact[1])
        said = sense.predicates if sense is not None else ()
        predicates = tuple((one.value, shown_predicate(one.text)) for one in said)
        on = branch.on_value(fact[1])
        yield RoomFact(
            key,
            branch.fact_name(fact[1]),
            reading.value,
            reading.reason,
            dict(predicates).get(on, predicates[-1][1] if predicates else "its sensor says so"),
            predicates,
            tuple(one.name for one in nodes),
            ", ".join(_who(one) for one in nodes),
            reading.age,
            needed.get(fact, ()),
            tuple(one.name for one in sense.sources) if sense is not None else (),
        )


def _who(tag: NodeTag) -> str:
    return tag.title if tag.standing == FRESH else f"{tag.title} {tag.standing}"


def _needs(blueprint: Blueprint) -> Mapping[FactKey, tuple[str, ...]]:
    """The operations that require each fact."""
    found: dict[FactKey, tuple[str, ...]] = {}
    for branch in blueprint:
        for name, note in branch.notes.operations.items():
            for key in note.requires:
                fact = split_fact(key)
                if fact is not None and name not in found.get(fact, ()):
                    found[fact] = (*found.get(fact, ()), name)
    return found
