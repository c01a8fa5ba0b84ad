"""Reads a configuration of XState 5 as a chart. Nothing that it names is called."""

from __future__ import annotations

from typing import Any

from smsl_studio.errors import Place, ReadError
from smsl_studio.exchange.carried import file_fields
from smsl_studio.exchange.chart import Chart, ChartNode, ChartWay, values_of_chart
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.json_text import json_document
from smsl_studio.smsl.document import Document

Json = Any
KNOWN = ("id", "key", "type", "initial", "states", "on", "always", "onDone", "meta", "target",
         "version", "order")  # fmt: skip
_KINDS = {"parallel": "parallel", "final": "final", "history": "history"}
_WAYS = ("on", "always", "onDone", "after", "invoke", "onError")


def xstate_values(text: str, file: str, findings: ExchangeFindings) -> dict[str, Json]:
    """Return the plain values of the blueprint that a machine shows. ReadError if it is none."""
    document = json_document(text, file)
    chart = _XstateReader(document, findings).chart()
    return values_of_chart(chart, findings)


class _XstateReader:
    def __init__(self, document: Document, findings: ExchangeFindings) -> None:
        self._document, self._findings = document, findings
        self._nodes: dict[str, ChartNode] = {}
        self._by_id: dict[str, ChartNode] = {}
        self._waiting: list[tuple[ChartNode, dict[str, Json], tuple[str, ...]]] = []

    def chart(self) -> Chart:
        values = dict(self._document.values)
        if not isinstance(values.get("states"), dict):
            raise self._wrong("a machine of XState has 'states', a map", ())
        name = values.get("id")
        named = name if isinstance(name, str) and name else "SB1"
        root = self._node(named, values, (), None)
        for node, value, path in self._waiting:
            self._ways(node, value, path)
        own = _own(values)
        file = own.get("file")
        fields = file_fields(file) if isinstance(file, dict) else {}
        return Chart(root, self._nodes, self._document.file, fields)

    def _node(
        self, key: str, value: dict[str, Json], path: tuple[str, ...], parent: ChartNode | None
    ) -> ChartNode:
        kind = value.get("type")
        own = _own(value)
        names = [own.get("branch"), own.get("state"), key]
        name = next(one for one in names if isinstance(one, str) and one)
        place = self._place(path)
        id_ = ".".join(path[1::2])
        if id_ in self._nodes:
            raise self._wrong(f"two states have the path {id_[:200]!r}", path)
        node = ChartNode(id_, name, _KINDS.get(str(kind), "state"), place, parent=parent)
        self._nodes[id_] = node
        if isinstance(value.get("id"), str):
            self._by_id[value["id"]] = node
        self._own_parts(node, own, path)
        before = f"{id_}." if id_ else ""
        if isinstance(value.get("initial"), str):
            node.initial = before + value["initial"]
        if isinstance(own.get("activating"), str):
            node.activating = before + own["activating"]
        states = value.get("states")
        for below, one in states.items() if isinstance(states, dict) else ():
            under = (*path, "states", below)
            if not isinstance(one, dict):
                raise self._wrong("a state of a machine is a map", under)
            node.children.append(self._node(below, one, under, node))
        self._waiting.append((node, value, path))
        for word in value:
            if word not in KNOWN and word not in _WAYS:
                words = f"{word!r} is not carried over."
                self._findings.add(word[:100], node.id or node.name, words, place)
        return node

    def _own_parts(self, node: ChartNode, own: dict[str, Json], path: tuple[str, ...]) -> None:
        carried = own.get("carried", {})
        if not isinstance(carried, dict):
            raise self._wrong("what Studio wrote beside a state is no map", path)
        if isinstance(own.get("branch"), str):
            node.branch = {k: v for k, v in carried.items() if k == "HEADER" or k[:1] == "_"}
        else:
            node.state = carried

    def _ways(self, node: ChartNode, value: dict[str, Json], path: tuple[str, ...]) -> None:
        for word in _WAYS:
            told = value.get(word)
            if word in ("on", "after") and isinstance(told, dict):
                for event, one in told.items():
                    name = event if word == "on" else f"after {event}"
                    self._some(node, name, one, (*path, word, event))
            elif word in ("always", "onDone") and told is not None:
                name = "always" if word == "always" else f"done.state.{node.id}"
                self._some(node, name, told, (*path, word))
            elif told is not None:
                words = f"{word!r} is not carried over: nothing is called."
                self._findings.add(word, node.id or node.name, words, self._place((*path, word)))

    def _some(self, node: ChartNode, event: str, told: Json, path: tuple[str, ...]) -> None:
        for at, one in enumerate(told if isinstance(told, list) else [told]):
            here = (*path, str(at)) if isinstance(told, list) else path
            way = self._way(node, event, one, here)
            if way is not None:
                node.ways.append(way)

    def _way(
        self, node: ChartNode, event: str, told: Json, path: tuple[str, ...]
    ) -> ChartWay | None:
        place = self._place(path)
        if isinstance(told, str):
            return ChartWay((event,), (self._target(node, told),), place)
        if not isinstance(told, dict):
            words = f"What happens on {event[:200]!r} is no transition."
            self._findings.add("transition", node.id or node.name, words, place)
            return None
        guarded = any(told.get(word) is not None for word in ("guard", "cond"))
        for word in told:
            if word not in ("target", "meta", "reenter", "internal", "description"):
                words = f"{word!r} of the transition on {event[:200]!r} is not carried over."
                self._findings.add(word[:100], node.id or node.name, words, place)
        target = told.get("target")
        listed = target if isinstance(target, list) else [] if target is None else [target]
        targets = tuple(self._target(node, one) for one in listed if isinstance(one, str))
        own = _own(told).get("operation")
        name = own if isinstance(own, str) else ""
        return ChartWay((event,), targets, place, name, guarded)

    def _target(self, node: ChartNode, text: str) -> str:
        """Return the id of a target: ``#id`` and what is below it, ``.below`` or a sibling."""
        if text.startswith("#"):
            named, _, rest = text[1:].partition(".")
            known = self._by_id.get(named)
            if known is None:
                return text
            return ".".join(part for part in (known.id, rest) if part)
        above = node if text.startswith(".") else node.parent or node
        return ".".join(part for part in (above.id, text.removeprefix(".")) if part)

    def _place(self, path: tuple[str, ...]) -> tuple[int, int]:
        place = self._document.place(path)
        return place.line, place.column

    def _wrong(self, words: str, path: tuple[str, ...]) -> ReadError:
        place = Place(self._document.file, *self._place(path))
        return ReadError(words, place, "Export the machine again, as JSON.")


def _own(value: dict[str, Json]) -> dict[str, Json]:
    """Return what Studio wrote into ``meta`` of an element."""
    meta = value.get("meta")
    own = meta.get("smsl") if isinstance(meta, dict) else None
    return own if isinstance(own, dict) else {}
