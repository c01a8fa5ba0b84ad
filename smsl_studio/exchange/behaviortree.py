"""Writes a blueprint for BehaviorTree.CPP 4: one tree for each SB, a sequence for each state."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edge, Edges
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import ConvertError, RunRefused
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.identifiers import Identifiers
from smsl_studio.exchange.left_out import told_of_left_out
from smsl_studio.exchange.nearness import far_from
from smsl_studio.exchange.required import required_states
from smsl_studio.exchange.xml_text import HEAD, shown, tag
from smsl_studio.stop import heed

_BUILT_IN = ("InState", "InOneOf", "Sequence", "Fallback", "ReactiveFallback", "SubTree", "Action",
             "Condition", "Control", "Decorator")  # fmt: skip


def as_behaviortree(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as trees of BehaviorTree.CPP 4. ConvertError if SBs contain each other.

    A tree is a reactive fallback: it succeeds in ACTIVATING, else the sequence of the active state
    tries the operations out of it, those first that lead nearest to ACTIVATING.
    """
    told_of_left_out(blueprint, findings, ("SUB_SBS",), "what is required")
    return _TreeWriter(blueprint, findings).text()


class _TreeWriter:
    def __init__(self, blueprint: Blueprint, findings: ExchangeFindings) -> None:
        self._blueprint, self._findings = blueprint, findings
        try:
            self._hierarchy = Hierarchy(blueprint)
        except RunRefused as error:
            raise ConvertError(error.sentence, error.place, error.advice) from None
        self._edges = Edges(self._hierarchy)
        trees, states, actions = Identifiers(), Identifiers(), Identifiers(_BUILT_IN)
        self._trees = {branch.name: trees.of(branch.name) for branch in blueprint}
        self._states = {
            (branch.name, state): states.of(f"{self._trees[branch.name]}_{state}")
            for branch in blueprint
            for state in branch.table
        }
        names = {name for branch in blueprint for name in branch.operation_names}
        self._actions = {name: actions.of(name, "op") for name in sorted(names)}

    def text(self) -> str:
        roots = self._hierarchy.roots
        head = {"BTCPP_format": "4"}
        if roots:
            head["main_tree_to_execute"] = self._trees[roots[0]]
        if len(roots) > 1:
            words = f"There are {len(roots)} roots. {roots[0]} is the main tree."
            self._findings.add("roots", "", words)
        lines = [HEAD, tag("root", head)]
        for branch in self._blueprint:
            lines.extend(f"    {line}" for line in self._tree(branch))
        lines.extend(f"    {line}" for line in self._model())
        return "\n".join([*lines, "</root>", ""])

    def _tree(self, branch: StateBranch) -> Iterator[str]:
        far = far_from(branch)
        yield tag("BehaviorTree", {"ID": self._trees[branch.name]})
        yield f"    {tag('ReactiveFallback', {'name': _name(branch.name)})}"
        if branch.activating in branch.table:
            yield f"        {self._in_state(branch, branch.activating)}"
        dropped = 0
        for state in branch.table:
            heed()
            edges = [e for e in self._edges.out(branch.name, state) if e.target in branch.table]
            edges.sort(
                key=lambda edge: (far.get(edge.target, float("inf")) + edge.price, edge.name)
            )
            if state == branch.activating:
                dropped += len(edges)
                continue
            if edges:
                yield from (f"        {line}" for line in self._state(branch, state, edges))
        yield "    </ReactiveFallback>"
        yield "</BehaviorTree>"
        if dropped:
            words = f"A tree ends in ACTIVATING: the {dropped} operations out of it are left out."
            self._findings.add("activating", branch.name, words)
        words = "A tree tries the operations of a state in one order, by the way to ACTIVATING."
        self._findings.add("order", branch.name, words)

    def _state(self, branch: StateBranch, state: str, edges: list[Edge]) -> Iterator[str]:
        yield tag("Sequence", {"name": _name(state)})
        yield f"    {self._in_state(branch, state)}"
        yield "    <Fallback>"
        for edge in edges:
            yield from (f"        {line}" for line in self._operation(branch, edge))
        yield "    </Fallback>"
        yield "</Sequence>"

    def _operation(self, branch: StateBranch, edge: Edge) -> Iterator[str]:
        before = [
            tag(
                "Condition",
                {"ID": "InOneOf", "states": ";".join(self._states[one] for one in ones)},
                "/",
            )
            for ones in required_states(self._blueprint, branch, edge.source, edge.name)
        ]
        if not edge.load:
            for digit in edge.rises:
                below = self._trees[branch.subs[digit]]
                before.append(tag("SubTree", {"ID": below, "_autoremap": "true"}, "/"))
            for digit in edge.falls:
                words = f"That {branch.subs[digit]} goes back to INITIAL is left out."
                self._findings.add("falls", str(edge.address), words)
        target = self._states[branch.name, edge.target]
        action = {"ID": self._actions[edge.name], "name": _name(edge.name), "target": target}
        own = tag("Action", action, "/")
        if not before:
            yield own
            return
        yield "<Sequence>"
        yield from (f"    {line}" for line in (*before, own))
        yield "</Sequence>"

    def _in_state(self, branch: StateBranch, state: str) -> str:
        known = self._states[branch.name, state]
        return tag("Condition", {"ID": "InState", "name": _name(state), "state": known}, "/")

    def _model(self) -> Iterator[str]:
        """Yield what a program must offer: two conditions, and an action for each operation."""
        yield "<TreeNodesModel>"
        for known, port in (("InState", "state"), ("InOneOf", "states")):
            yield f"    {tag('Condition', {'ID': known})}"
            yield f"        {tag('input_port', {'name': port, 'type': 'std::string'}, '/')}"
            yield "    </Condition>"
        for known in self._actions.values():
            yield f"    {tag('Action', {'ID': known})}"
            yield f"        {tag('input_port', {'name': 'target', 'type': 'std::string'}, '/')}"
            yield "    </Action>"
        yield "</TreeNodesModel>"


def _name(name: str) -> str:
    """Return a name that is only shown."""
    return shown(name)
