"""Blueprints as networkx graphs, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.graph.exchange import graph_of_blueprint, graph_of_branch, values_of_graph
from smsl_studio.smsl.json_form import parse_json, write_json

if TYPE_CHECKING:
    from smsl_studio.graph.exchange import Graph


def multidigraph(what: StateBranch | Blueprint) -> Graph:
    """Return an SB or a blueprint as a networkx MultiDiGraph (paper, FSM-G).

    Nodes of an SB are the names of its states, those of a blueprint are addresses (``SB/State``).
    A node has ``branch``, ``state``, ``facts`` (the values, with spaces between them), ``title``,
    ``initial`` and ``activating``. Edges are keyed by the name of the operation, and have ``kind``,
    ``cost`` and ``risk``. Of a blueprint, edges of the kind ``sub`` lead from each state of a base
    in which a digit is on to the ACTIVATING state of its sub-SB. All attributes are texts, numbers
    and truth values, so that GraphML can hold them.

    >>> graph = multidigraph(read("hanoi-corrected.json")["SB1"])
    >>> graph.number_of_nodes(), graph.number_of_edges()
    (27, 78)
    >>> graph.edges["State_aaa", "State_baa", "Op_1b"]["cost"]
    1.0
    """
    return graph_of_branch(what) if isinstance(what, StateBranch) else graph_of_blueprint(what)


def from_multidigraph(graph: Graph, file: str = "untitled.json") -> Blueprint:
    """Return the blueprint that a graph of ``multidigraph`` shows, also after it was changed.

    States and operations are those of the graph. Headers and annotations are those that the graph
    was made with. UsageError for a node without SB, or an operation that leads to another SB.

    >>> blueprint = read("hfsm.json")
    >>> from_multidigraph(multidigraph(blueprint)) == blueprint
    True
    """
    return read_blueprint(parse_json(write_json(values_of_graph(graph)), file))
