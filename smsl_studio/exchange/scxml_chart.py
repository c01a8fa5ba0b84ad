"""Reads SCXML as a chart. Scripts and conditions are told and never run, nothing is fetched."""

from __future__ import annotations

from typing import Any

from smsl_studio.errors import Place, ReadError
from smsl_studio.exchange.carried import file_fields, from_json
from smsl_studio.exchange.chart import Chart, ChartNode, ChartWay, values_of_chart
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.xml_text import SMSL, exact_of
from smsl_studio.exchange.xml_tree import XmlElement, xml_tree

KINDS = {"state": "state", "parallel": "parallel", "final": "final", "history": "history"}
_LEFT_OUT = {
    "script": "A script is not run and not carried over.",
    "datamodel": "The data model is not carried over.",
    "onentry": "What happens on entry is not carried over.",
    "onexit": "What happens on exit is not carried over.",
    "invoke": "What it invokes is neither fetched nor run.",
    "include": "What it includes is not fetched.",
    "donedata": "The data of a final state are not carried over.",
}
Json = Any


def scxml_chart(text: str, file: str, findings: ExchangeFindings) -> Chart:
    """Return the chart of an SCXML text. ReadError, with its place, if it is none."""
    root = xml_tree(text, file)
    if root.name != "scxml":
        words = f"its root element is {root.name!r} and not 'scxml'"
        raise ReadError(words, Place(file, *root.place), "Name a file of SCXML.")
    return _ScxmlReader(file, findings).chart(root)


def scxml_values(text: str, file: str, findings: ExchangeFindings) -> dict[str, Json]:
    """Return the plain values of the blueprint that an SCXML text shows (see ``chart``)."""
    return values_of_chart(scxml_chart(text, file, findings), findings)


class _ScxmlReader:
    def __init__(self, file: str, findings: ExchangeFindings) -> None:
        self._file, self._findings = file, findings
        self._nodes: dict[str, ChartNode] = {}

    def chart(self, root: XmlElement) -> Chart:
        fields: dict[str, Json] = {}
        for one in root.named("file"):
            if one.space == SMSL:
                fields = file_fields(from_json(one.text, self._file, one.place))
        name = root.get("name") or "SB1"
        node = ChartNode("", name, "state", root.place, root.get("initial").split(" ")[0])
        self._fill(node, root)
        return Chart(node, self._nodes, self._file, fields)

    def _node(self, element: XmlElement, parent: ChartNode) -> ChartNode:
        known = element.get("id")
        if known in self._nodes:
            words = f"two states have the id {known[:200]!r}"
            raise ReadError(words, Place(self._file, *element.place), "Give one another id.")
        key = known or f"(state {len(self._nodes) + 1})"
        name = exact_of(element, f"{{{SMSL}}}name", self._file) or known or "state"
        node = ChartNode(key, name, KINDS[element.name], element.place, parent=parent)
        self._nodes[key] = node
        node.initial = element.get("initial").split(" ")[0]
        node.activating = element.get(f"{{{SMSL}}}activating")
        self._fill(node, element)
        return node

    def _fill(self, node: ChartNode, element: XmlElement) -> None:
        if element.get("src"):
            words = f"It names another file, {element.get('src')[:200]!r}, which is not fetched."
            self._findings.add("source", node.id, words, element.place)
        for one in element.children:
            if one.space == SMSL:
                self._own(node, one)
            elif one.name in KINDS:
                node.children.append(self._node(one, node))
            elif one.name == "transition":
                node.ways.append(self._way(node, one))
            elif one.name == "initial":
                for way in one.named("transition"):
                    node.initial = way.get("target").split(" ")[0]
            else:
                words = _LEFT_OUT.get(one.name, f"The element {one.name!r} is not carried over.")
                self._findings.add(one.name, node.id or node.name, words, one.place)

    def _own(self, node: ChartNode, element: XmlElement) -> None:
        if element.name == "branch":
            values = from_json(element.text, self._file, element.place)
            node.branch = {k: v for k, v in values.items() if k == "HEADER" or k[:1] == "_"}
        elif element.name == "state":
            node.state = from_json(element.text, self._file, element.place)

    def _way(self, node: ChartNode, element: XmlElement) -> ChartWay:
        events = tuple(element.get("event").split())
        cond, own = element.get("cond"), element.get(f"{{{SMSL}}}cond")
        if cond != own:
            words = f"The condition {cond[:200]!r} is not carried over."
            self._findings.add("cond", node.id or node.name, words, element.place)
        for one in element.children:
            words = _LEFT_OUT.get(one.name, "What happens on the way is not carried over.")
            self._findings.add(one.name, node.id or node.name, words, one.place)
        name = exact_of(element, f"{{{SMSL}}}name", self._file)
        if not events and not name:
            words = "A transition without an event is called 'always'."
            self._findings.add("event", node.id or node.name, words, element.place)
        targets = tuple(element.get("target").split())
        return ChartWay(events, targets, element.place, name, bool(cond) and cond != own)
