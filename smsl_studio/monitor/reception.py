"""The reception: it checks every network message before the monitor uses it.

It needs no network itself. A readable message from a declared source becomes a sample; the newest
sample of each source waits. Every other message is counted under the kind of its fault, with the
newest example, and refreshes no fact. Any thread may call it.
"""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from smsl_studio.monitor.bus import FactBus, SourceKey, too_long
from smsl_studio.monitor.facts import FactSource
from smsl_studio.monitor.message import UnreadableError, read_fact, read_status
from smsl_studio.monitor.nodes import Nodes, NodeState
from smsl_studio.monitor.sample import Sample
from smsl_studio.monitor.topics import FactTopic, StatusTopic, read_topic

TOPIC, SITE, RUN, RETAINED, STRANGER, PAYLOAD, STATUS, LONG, OVERTAKEN, POSING = (
    "unknown topic",
    "another site",
    "another run",
    "retained fact",
    "undeclared source",
    "unreadable fact",
    "unreadable status",
    "too long",
    "overtaken before it was read",
    "under the name of another node",
)
"""The kinds of messages that do not count."""

NO_SPEAKERS: Mapping[SourceKey, str] = MappingProxyType({})

FEW = 100
"""The number of samples below which a source never counts as flooding."""
SHOWN = 120
"""The largest length of an example, in characters."""


@dataclass(frozen=True, slots=True)
class RefusedMessages:
    """The messages that do not count for one reason: their number, and the newest in words."""

    kind: str
    count: int
    example: str


@dataclass(frozen=True, slots=True)
class Received:
    """The numbers of received messages, of samples among them, and of every kind of refusal.

    ``replaced`` is the number of samples that a newer sample of their source replaced before they
    were fetched.
    """

    messages: int
    samples: int
    replaced: int
    refusals: tuple[RefusedMessages, ...]


@dataclass(frozen=True, slots=True)
class RemoteView:
    """The state of the network, for people: the broker, its nodes, and the received messages.

    ``lost`` is the time (s) since the connection was lost; None means that it is connected.
    ``secure`` says that the connection is encrypted and that the broker has shown its certificate.
    """

    broker: str
    site: str
    run: str
    lost: float | None
    connections: int
    nodes: tuple[NodeState, ...]
    received: Received
    secure: bool = False


class Reception:
    """Receives the messages of the declared sources, for one run of one site.

    Those in ``measures`` say numbers, all others a value of their fact. ``speakers`` has the node
    that speaks for a source. A message of this source that names another node does not count.
    Without an entry any node may speak.
    """

    def __init__(
        self,
        site: str,
        run: str,
        sources: Iterable[FactSource],
        measures: Collection[SourceKey] = (),
        speakers: Mapping[SourceKey, str] = NO_SPEAKERS,
    ) -> None:
        self.site, self.run = site, run
        self._declared: Mapping[SourceKey, float] = {
            (source.branch, source.digit, source.name): source.max_age for source in sources
        }
        self._measures = frozenset(measures)
        self._speakers = speakers
        self._known = frozenset(speakers.values())
        topics = (FactTopic(site, run, *key) for key in self._declared)
        self.topics: Mapping[str, FactTopic] = {str(topic): topic for topic in topics}
        """The topics of the declared sources."""
        self._bus = FactBus()
        self._inbox = self._bus.subscribe()
        self._lock = threading.Lock()
        self._nodes = Nodes()
        self._messages = self._samples = 0
        self._spoken: Counter[SourceKey] = Counter()
        self._refused: dict[str, tuple[int, str]] = {}
        self._silent = set(self._declared)

    def receive(self, topic: str, payload: bytes, retained: bool, now: float) -> None:
        """Take in one message, which arrived at ``now`` (s, the receiver's monotonic clock)."""
        about = self.topics.get(topic) or read_topic(topic)
        with self._lock:
            self._messages += 1
            match about:
                case StatusTopic(site, node) if site == self.site:
                    self._status(node, payload, now)
                case FactTopic(site, run) as about if (site, run) == (self.site, self.run):
                    self._fact(about, payload, retained, now)
                case None:
                    self._refuse(TOPIC, topic)
                case StatusTopic(site) | FactTopic(site) if site != self.site:
                    self._refuse(SITE, site)
                case FactTopic(_, run):
                    self._refuse(RUN, run)

    def take(self) -> tuple[Sample, ...]:
        """Return the newest sample of every source since the last call."""
        return self._inbox.take()

    @property
    def silent(self) -> tuple[SourceKey, ...]:
        """The declared sources that have sent no sample yet."""
        with self._lock:
            return tuple(sorted(self._silent))

    def nodes(self, now: float) -> tuple[NodeState, ...]:
        """Return the state of every known node at ``now`` (s)."""
        with self._lock:
            return self._nodes.states(now)

    @property
    def received(self) -> Received:
        """The numbers of messages so far."""
        with self._lock:
            refusals = [
                RefusedMessages(kind, *said) for kind, said in sorted(self._refused.items())
            ]
            replaced, worst = self._bus.counts.replaced, self._bus.flooding
            if worst is not None and self._floods(worst):
                refusals.append(
                    RefusedMessages(OVERTAKEN, replaced, _who(FactTopic("", "", *worst)))
                )
            return Received(self._messages, self._samples, replaced, tuple(refusals))

    def _floods(self, key: SourceKey) -> bool:
        """Whether a source sends ten times as many samples as are fetched."""
        spoken = self._spoken[key]
        left_out = self._bus.replaced(key[:2], key[2])
        return spoken > FEW and left_out > 0.9 * spoken

    def _status(self, node: str, payload: bytes, now: float) -> None:
        if self._known and node not in self._known:
            self._refuse(STATUS, f"{node}: no node of this site")
            return
        try:
            words = self._nodes.said(node, read_status(payload), now)
        except UnreadableError as error:
            words = str(error)
        if words:
            self._refuse(STATUS, f"{node}: {words}")

    def _fact(self, topic: FactTopic, payload: bytes, retained: bool, now: float) -> None:
        key = (topic.branch, topic.digit, topic.source)
        max_age = self._declared.get(key)
        if max_age is None:
            self._refuse(STRANGER, _who(topic))
        elif retained:
            self._refuse(RETAINED, _who(topic))
        else:
            try:
                node, said = read_fact(topic, payload, now, measures=key in self._measures)
            except UnreadableError as error:
                self._refuse(PAYLOAD, f"{_who(topic)}: {error}")
                return
            belongs = self._speakers.get(key, node)
            if node != belongs:
                self._refuse(POSING, f"{_who(topic)}: {node or 'nobody'}, not {belongs}")
                return
            sample = said._replace(node=node)
            if too_long(sample):
                self._refuse(LONG, _who(topic))
                return
            self._bus.publish((sample,))
            self._samples += 1
            self._spoken[key] += 1
            self._silent.discard(key)
            if node:
                self._nodes.spoke(node, sample, max_age, now)

    def _refuse(self, kind: str, example: str) -> None:
        count, _ = self._refused.get(kind, (0, ""))
        self._refused[kind] = (count + 1, example[:SHOWN])


def _who(topic: FactTopic) -> str:
    return f"{topic.branch}/{topic.digit} {topic.source}"
