"""State Branches and blueprints as networkx graphs, and back (paper, FSM-G).

All attributes are texts, numbers and truth values, so that every writer of networkx can write them,
GraphML for one. networkx is loaded when it is first asked for.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.imported_files import KEY as IMPORTS
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.blueprint.writing import branch_values, file_values
from smsl_studio.errors import UsageError

if TYPE_CHECKING:
    from networkx import MultiDiGraph

    Graph = MultiDiGraph[str]

Json = Any
OPERATION, SUB = "operation", "sub"
"""The kinds of edges: an operation, or the link from a base's state to a sub-SB."""

FILE = "file"
"""The attribute of a graph with the ``_`` fields of its file, as JSON."""


def graph_of_branch(branch: StateBranch) -> Graph:
    """Return one SB as a graph. Its nodes are the names of the states."""
    graph = _new_graph()
    graph.graph[branch.name] = _head(branch)
    _add_branch(graph, branch, lambda state: state)
    return graph


def graph_of_blueprint(blueprint: Blueprint) -> Graph:
    """Return all SBs as one graph. Its nodes are the addresses of the states.

    An edge of the kind ``sub`` leads from each state of a base in which a digit is on to the
    ACTIVATING state of the sub-SB that expands this digit. SBs of imported files are in it, too.
    """
    graph = _new_graph()
    kept = {key: value for key, value in file_values(blueprint).items() if key != IMPORTS}
    graph.graph[FILE] = json.dumps(kept)
    for branch in blueprint:
        graph.graph[branch.name] = _head(branch)
        _add_branch(graph, branch, partial(_address, branch.name))
    for branch in blueprint:
        for digit, sub in branch.subs.items():
            below = blueprint.branches.get(sub)
            if below is None or below.activating not in below.table:
                continue
            end = str(Address(sub, below.activating))
            for state in branch.table:
                if branch.is_on(state, digit):
                    start = str(Address(branch.name, state))
                    graph.add_edge(start, end, f"{SUB} {digit}", kind=SUB, digit=digit)
    return graph


def values_of_graph(graph: Graph) -> dict[str, Json]:
    """Return the plain values of the blueprint that a graph shows.

    States and operations are those of the graph as it is now. Headers and annotations are those
    that the graph was made with. UsageError if a node has no SB, or an edge leads to another SB.
    """
    found: dict[str, Json] = {}
    for node, row in graph.nodes(data=True):
        branch, state = _names(node, row)
        if branch not in found:
            found[branch] = _read(graph.graph.get(branch), branch)
        found[branch][state] = _read(row.get("fields", "{}"), "fields")
    for source, target, key, row in graph.edges(keys=True, data=True):
        if row.get("kind") == SUB:
            continue
        branch, state = _names(source, graph.nodes[source])
        other, end = _names(target, graph.nodes[target])
        if branch != other:
            raise UsageError(
                f"the operation {key} leads from {branch}/{state} to another SB, {other}",
                advice=f"Give the edge the kind {SUB!r} if it links a base with a sub-SB.",
            )
        found[branch][state][str(key)] = end
    return {**_read(graph.graph.get(FILE), FILE), **found}


def _address(branch: str, state: str) -> str:
    return str(Address(branch, state))


def _new_graph() -> Graph:
    import networkx

    return networkx.MultiDiGraph()


def _add_branch(graph: Graph, branch: StateBranch, node_of: Callable[[str], str]) -> None:
    for state in branch.table:
        note = branch.state_note(state)
        title = note.title if note else ""
        graph.add_node(
            node_of(state),
            branch=branch.name,
            state=state,
            facts=" ".join(branch.facts(state)),
            title=title or "",
            initial=state == branch.initial,
            activating=state == branch.activating,
            fields=json.dumps(dict(branch.state_fields.get(state, {}))),
        )
    for edge in branch.edges():
        if edge.target not in branch.table:
            continue
        graph.add_edge(
            node_of(edge.source),
            node_of(edge.target),
            edge.name,
            kind=OPERATION,
            cost=float(branch.cost(edge.source, edge.name)),
            risk=branch.operation_note(edge.source, edge.name).risk or "",
        )


def _head(branch: StateBranch) -> str:
    """Return the header and the annotations of an SB as JSON."""
    values = branch_values(branch)
    return json.dumps({key: value for key, value in values.items() if key not in branch.table})


def _read(text: Json, name: str) -> dict[str, Json]:
    """Return what a graph keeps of a header or a file, an empty map if it keeps nothing."""
    if text is None:
        return {HEADER: {}} if name != FILE else {}
    try:
        found = json.loads(text)
    except (TypeError, ValueError):
        found = None
    if not isinstance(found, dict):
        raise UsageError(f"the attribute {name!r} of the graph is no JSON object")
    return found


def _names(node: str, row: Mapping[str, Json]) -> tuple[str, str]:
    """Return the SB and the name of a state."""
    branch, state = row.get("branch"), row.get("state", node)
    if not isinstance(branch, str) or not branch:
        raise UsageError(
            f"the node {node!r} has no SB", advice="Give it the attribute 'branch', a name."
        )
    return branch, str(state)
