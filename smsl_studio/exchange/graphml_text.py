"""Writes a blueprint as GraphML, as networkx, Gephi, yEd, Cytoscape and igraph read it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.exchange.carried import as_json, branch_carried, file_carried, state_carried
from smsl_studio.exchange.engines import told_of_absent, told_of_imports
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.xml_text import HEAD, shown, tag, text_element
from smsl_studio.stop import heed

GRAPHML = "http://graphml.graphdrawing.org/xmlns"
KEYS = (
    ("graph", "smsl_file", "string"),
    ("graph", "smsl_branches", "string"),
    ("node", "label", "string"),
    ("node", "branch", "string"),
    ("node", "state", "string"),
    ("node", "facts", "string"),
    ("node", "title", "string"),
    ("node", "initial", "boolean"),
    ("node", "activating", "boolean"),
    ("node", "smsl", "string"),
    ("edge", "label", "string"),
    ("edge", "operation", "string"),
    ("edge", "kind", "string"),
    ("edge", "cost", "double"),
    ("edge", "risk", "string"),
    ("edge", "smsl", "string"),
)
"""What nodes and edges have: for what, the name, and the type."""


def as_graphml(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as GraphML: its states are nodes, its operations are edges.

    An edge of the kind ``sub`` leads from each state of a base in which a digit is on to the
    ACTIVATING state of the sub-SB, as in ``multidigraph``.
    """
    told_of_imports(blueprint, findings)
    nodes: dict[tuple[str, str], str] = {}
    for branch in blueprint:
        told_of_absent(blueprint, branch.name, findings)
        for state in branch.table:
            nodes[branch.name, state] = f"n{len(nodes)}"
    lines = [HEAD, tag("graphml", {"xmlns": GRAPHML})]
    for number, (kind, name, of) in enumerate(KEYS):
        key = {"id": f"d{number}", "for": kind, "attr.name": name, "attr.type": of}
        lines.append(f"    {tag('key', key, '/')}")
    lines.append(f"    {tag('graph', {'id': 'blueprint', 'edgedefault': 'directed'})}")
    heads = {branch.name: branch_carried(branch) for branch in blueprint}
    graph = {"smsl_file": as_json(file_carried(blueprint)), "smsl_branches": as_json(heads)}
    lines.extend(f"        {line}" for line in _data("graph", graph))
    for branch in blueprint:
        lines.extend(f"        {line}" for line in _nodes(branch, nodes))
    for branch in blueprint:
        lines.extend(f"        {line}" for line in _edges(blueprint, branch, nodes))
    return "\n".join([*lines, "    </graph>", "</graphml>", ""])


def _nodes(branch: StateBranch, nodes: dict[tuple[str, str], str]) -> Iterator[str]:
    for state in branch.table:
        heed()
        note = branch.state_note(state)
        carried = {"branch": branch.name, "state": state, "fields": state_carried(branch, state)}
        told = {
            "label": state,
            "branch": branch.name,
            "state": state,
            "facts": " ".join(branch.facts(state)),
            "title": note.title if note else "",
            "initial": str(state == branch.initial).lower(),
            "activating": str(state == branch.activating).lower(),
            "smsl": as_json(_needed(carried)),
        }
        yield tag("node", {"id": nodes[branch.name, state]})
        yield from (f"    {line}" for line in _data("node", told))
        yield "</node>"


def _needed(carried: Mapping[str, object]) -> dict[str, object]:
    """Return what is not said already: a name that XML can hold stands in its own field."""
    return {
        key: value
        for key, value in carried.items()
        if value and not (isinstance(value, str) and _is_plain(value))
    }


def _is_plain(name: str) -> bool:
    return name == shown(name) and "\r" not in name and bool(name.strip())


def _edges(
    blueprint: Blueprint, branch: StateBranch, nodes: dict[tuple[str, str], str]
) -> Iterator[str]:
    for edge in branch.edges():
        heed()
        end = nodes.get((branch.name, edge.target))
        if end is None:
            continue
        note = branch.operation_note(edge.source, edge.name)
        told = {
            "label": edge.name,
            "operation": edge.name,
            "kind": "operation",
            "cost": repr(float(branch.cost(edge.source, edge.name))),
            "risk": note.risk or "",
            "smsl": as_json(_needed({"operation": edge.name})),
        }
        yield from _edge(nodes[branch.name, edge.source], end, told)
    for digit, sub in branch.subs.items():
        below = blueprint.branches.get(sub)
        end = nodes.get((sub, below.activating)) if below else None
        if end is None:
            continue
        for state in branch.table:
            if branch.is_on(state, digit):
                told = {"label": f"sub {digit}", "kind": "sub"}
                yield from _edge(nodes[branch.name, state], end, told)


def _edge(source: str, target: str, told: dict[str, str]) -> Iterator[str]:
    yield tag("edge", {"source": source, "target": target})
    yield from (f"    {line}" for line in _data("edge", told))
    yield "</edge>"


def _data(kind: str, told: dict[str, str]) -> Iterator[str]:
    for number, (of, name, _) in enumerate(KEYS):
        value = told.get(name, "") if of == kind else ""
        if value and value != "{}":
            yield text_element("data", value.replace("\r", "\n"), {"key": f"d{number}"})
