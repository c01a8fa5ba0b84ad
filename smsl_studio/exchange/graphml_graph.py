"""Reads GraphML: nodes are states, edges are operations.

A graph that Studio wrote gives the same blueprint. Of any other graph the names are sought in the
fields that other programs use, and the graph becomes one SB.
"""

from __future__ import annotations

from typing import Any

from smsl_studio.errors import Place, ReadError
from smsl_studio.exchange.carried import file_fields, from_json, with_ends
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.foreign_names import ForeignNames
from smsl_studio.exchange.xml_tree import XmlElement, xml_tree
from smsl_studio.stop import heed

Json = Any
NODE_NAMES = ("state", "label", "name", "NodeLabel")
EDGE_NAMES = ("operation", "label", "name", "EdgeLabel", "event")
_LEFT_OUT = {"port": "Ports", "hyperedge": "Hyperedges", "locator": "Links to other files"}


def graphml_values(text: str, file: str, findings: ExchangeFindings) -> dict[str, Json]:
    """Return the plain values of the blueprint that a graph shows. ReadError if it is none."""
    root = xml_tree(text, file)
    if root.name != "graphml":
        words = f"its root element is {root.name!r} and not 'graphml'"
        raise ReadError(words, Place(file, *root.place), "Name a file of GraphML.")
    return _GraphmlReader(file, findings).values(root)


class _GraphmlReader:
    def __init__(self, file: str, findings: ExchangeFindings) -> None:
        self._file, self._findings = file, findings
        self._keys: dict[str, str] = {}
        self._branches: dict[str, dict[str, Json]] = {}
        self._heads: dict[str, Json] = {}
        self._names: dict[str, ForeignNames] = {}
        self._sbs = ForeignNames("State Branch", findings)
        self._known: dict[str, str] = {}
        """The name of each SB in the blueprint, by its name in the graph."""
        self._at: dict[str, tuple[str, str]] = {}
        self._ends: dict[str, dict[str, str]] = {}
        self._edge_names: dict[tuple[str, str], ForeignNames] = {}
        self._edges: list[XmlElement] = []

    def values(self, root: XmlElement) -> dict[str, Json]:
        for key in root.named("key"):
            self._keys[key.get("id")] = key.get("attr.name") or key.get("yfiles.type")
        graphs = list(root.named("graph"))
        if not graphs:
            raise self._wrong("it holds no graph", root)
        fields: dict[str, Json] = {}
        for graph in graphs:
            told = self._data(graph)
            place = graph.place
            if "smsl_file" in told:
                fields |= file_fields(from_json(told["smsl_file"], self._file, place))
            if "smsl_branches" in told:
                self._heads |= from_json(told["smsl_branches"], self._file, place)
            for name in self._heads:
                self._branch(name, place)
            if graph.get("edgedefault") == "undirected":
                words = "The graph is undirected. An edge leads from its source to its target."
                self._findings.add("undirected", graph.get("id"), words, place)
            self._graph(graph)
        for edge in self._edges:
            heed()
            self._edge(edge)
        for name, branch in self._branches.items():
            ends = self._ends.get(name, {})
            with_ends(branch, ends.get("initial", ""), ends.get("activating", ""))
        return {**fields, **self._branches}

    def _graph(self, graph: XmlElement) -> None:
        for one in graph.children:
            if one.name == "node":
                self._node(one)
                for inner in one.named("graph"):
                    words = "A graph inside a node stands beside it: groups are not carried over."
                    self._findings.add("group", one.get("id"), words, one.place)
                    self._graph(inner)
            elif one.name == "edge":
                self._edges.append(one)
            elif one.name in _LEFT_OUT:
                words = f"{_LEFT_OUT[one.name]} are not carried over."
                self._findings.add(one.name, one.get("id"), words, one.place)

    def _node(self, node: XmlElement) -> None:
        known = node.get("id")
        if not known or known in self._at:
            raise self._wrong(f"a node needs an id of its own, not {known[:200]!r}", node)
        told = self._data(node)
        own = from_json(told["smsl"], self._file, node.place) if "smsl" in told else {}
        sb = self._text(own.get("branch")) or told.get("branch") or "SB1"
        name = self._branch(sb, node.place)
        wanted = self._text(own.get("state")) or self._named(told, NODE_NAMES) or known
        state = self._names[name].of(wanted, node.place)
        self._at[known] = name, state
        fields = own.get("fields")
        self._branches[name][state] = dict(fields) if isinstance(fields, dict) else {}
        for end in ("initial", "activating"):
            if told.get(end, "").strip() in ("true", "True", "1"):
                self._ends.setdefault(name, {})[end] = state

    def _branch(self, sb: str, place: tuple[int, int]) -> str:
        """Return the name of an SB in the blueprint. It is begun if it is new."""
        if sb not in self._known:
            name = self._known[sb] = self._sbs.of(sb, place)
            head = self._heads.get(sb)
            values = head if isinstance(head, dict) else {}
            kept = {k: v for k, v in values.items() if k == "HEADER" or k[:1] == "_"}
            self._branches[name] = kept
            self._names[name] = ForeignNames("state", self._findings)
        return self._known[sb]

    def _edge(self, edge: XmlElement) -> None:
        told = self._data(edge)
        if told.get("kind") == "sub":
            return
        ends = []
        for side in ("source", "target"):
            at = self._at.get(edge.get(side))
            if at is None:
                raise self._wrong(f"the {side} {edge.get(side)[:200]!r} is no node", edge)
            ends.append(at)
        (branch, source), (other, target) = ends
        own = from_json(told["smsl"], self._file, edge.place) if "smsl" in told else {}
        wanted = self._text(own.get("operation")) or self._named(told, EDGE_NAMES)
        wanted = wanted or edge.get("id")
        if not wanted:
            wanted = f"to {target}"
            words = f"An edge without a name is called {wanted[:200]!r}."
            self._findings.add("name", f"{branch}/{source}"[:400], words, edge.place)
        if branch != other:
            words = f"The edge {wanted[:200]!r} leads to another SB, and is left out."
            self._findings.add("edge", f"{branch}/{source}"[:400], words, edge.place)
            return
        names = self._edge_names.get((branch, source))
        if names is None:
            names = self._edge_names[branch, source] = ForeignNames("operation", self._findings)
        self._branches[branch][source][names.of(wanted, edge.place)] = target

    def _data(self, element: XmlElement) -> dict[str, str]:
        """Return the fields of an element by their names. yEd puts labels deeper."""
        found: dict[str, str] = {}
        for one in element.named("data"):
            name = self._keys.get(one.get("key"), one.get("key"))
            found.setdefault(name, one.text if not one.children else _label(one))
        return {key: value for key, value in found.items() if value.strip()}

    def _named(self, told: dict[str, str], names: tuple[str, ...]) -> str:
        by_small = {key.lower(): value for key, value in told.items()}
        for name in (*names, "nodegraphics", "edgegraphics"):
            if found := by_small.get(name.lower(), ""):
                return found if name in ("state", "operation") else found.strip()
        return ""

    def _text(self, value: Json) -> str:
        return value if isinstance(value, str) else ""

    def _wrong(self, words: str, element: XmlElement) -> ReadError:
        place = Place(self._file, *element.place)
        return ReadError(words, place, "Save it again with the program that made it.")


def _label(element: XmlElement) -> str:
    """Return the first label below an element, as yEd writes it."""
    waiting = list(element.children)
    while waiting:
        one = waiting.pop(0)
        if one.name in ("NodeLabel", "EdgeLabel") and one.text.strip():
            return one.text.strip()
        waiting[:0] = one.children
    return ""
