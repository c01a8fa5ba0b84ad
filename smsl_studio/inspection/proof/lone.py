"""Explores an SB that does not depend on any other SB. Its graph has all its steps."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address, escape
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.graph.build import graph_of
from smsl_studio.inspection.proof.cone import Cone
from smsl_studio.inspection.proof.exploration import MOST_STEPS, NOWHERE, Exploration
from smsl_studio.stop import BoundMet, heed


def is_lone(hierarchy: Hierarchy, cone: Cone) -> bool:
    """Whether a question is about one SB without bases, sub-SBs and ``requires``."""
    if cone.quiet or len(cone.kept) != 1:
        return False
    (name,) = cone.kept
    notes = hierarchy.blueprint[name].notes.operations.values()
    return not (
        hierarchy.subs[name] or hierarchy.bases[name] or any(note.requires for note in notes)
    )


class LoneExploration(Exploration):
    """The reachable states of such an SB. The label of a step is the number of its edge."""

    def name(self, label: int) -> Address:
        """Return the address of the operation with this number."""
        graph = self._graph
        return Address(graph.branch, graph.names[graph.sources[label]], graph.operations[label])

    def _explore(self) -> None:
        (name,) = self.space.order
        branch = self.space.blueprint[name]
        graph = self._graph = graph_of(branch)
        operations = sorted(set(graph.operations), key=escape)
        rank = {operation: number for number, operation in enumerate(operations)}
        by_address = [rank[operation] for operation in graph.operations].__getitem__
        failing = failing_states(branch) if self.space.routed else {}
        closed = fails = [False] * len(graph)
        if self.space.routed:
            closed = [self.space.shuts((state,)) for state in graph.names]
            fails = [state in failing for state in graph.names]
        guarded = any(closed) or any(fails)
        targets, names = graph.targets, graph.names
        to_targets, to_labels = self._targets.append, self._labels.append
        here = [graph.index[state] for (state,) in self.keys]
        node_of = [NOWHERE] * len(graph)
        for node, state in enumerate(here):
            node_of[state] = node
        for node, state in enumerate(here):
            try:
                heed()
                self._tell(len(here))
            except BoundMet as error:
                self.bound = str(error)
                return
            edges = graph.edges_out(state)
            for edge in sorted(edges, key=by_address) if len(edges) > 1 else edges:
                target = targets[edge]
                if guarded and (closed[target] or (fails[target] and not fails[state])):
                    continue
                to = node_of[target]
                if to < 0:
                    to = self._add((names[target],), node, edge)
                    if to < 0:
                        self._first.append(len(self._targets))
                        return
                    node_of[target] = to
                    here.append(target)
                to_targets(to)
                to_labels(edge)
            self._first.append(len(self._targets))
            if len(self._targets) > MOST_STEPS:
                count = f"{len(self.keys):,} configurations"
                self.bound = f"{count} with {MOST_STEPS:,} steps, which would fill the memory"
                return
