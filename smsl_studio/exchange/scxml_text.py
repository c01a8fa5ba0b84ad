"""Writes a blueprint as SCXML 1.0 (W3C): a state for each SB, with its states in it."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.exchange.carried import as_json, branch_carried, file_carried, state_carried
from smsl_studio.exchange.engines import told_of_engines
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.identifiers import Identifiers
from smsl_studio.exchange.required import required_states
from smsl_studio.exchange.xml_text import HEAD, SMSL, exact, tag, text_element
from smsl_studio.stop import heed

SCXML = "http://www.w3.org/2005/07/scxml"


def as_scxml(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as SCXML. Several SBs are the regions of one parallel state.

    Events are the names of operations, with the SB before them if there are several. What an
    operation requires is its ``cond``. The rest stands in elements of Studio's own namespace.
    """
    return _ScxmlWriter(blueprint, findings).text()


class _ScxmlWriter:
    def __init__(self, blueprint: Blueprint, findings: ExchangeFindings) -> None:
        self._blueprint = blueprint
        told_of_engines(blueprint, "an engine of SCXML", findings, asks_requires=True)
        free = Identifiers(("blueprint",))
        self._ids: dict[tuple[str, str], str] = {}
        for branch in blueprint:
            self._ids[branch.name, ""] = known = free.of(branch.name)
            for state in branch.table:
                self._ids[branch.name, state] = free.of(f"{known}_{state}")

    def text(self) -> str:
        """Return the whole text."""
        head = {"xmlns": SCXML, "xmlns:smsl": SMSL, "version": "1.0", "datamodel": "ecmascript"}
        several = len(self._blueprint) > 1
        lines = [HEAD, tag("scxml", head)]
        if carried := file_carried(self._blueprint):
            lines.append(f"    {text_element('smsl:file', as_json(carried))}")
        if several:
            lines.append('    <parallel id="blueprint">')
        indent = "        " if several else "    "
        for branch in self._blueprint:
            lines.extend(indent + line for line in self._branch(branch, several))
        if several:
            lines.append("    </parallel>")
        return "\n".join([*lines, "</scxml>", ""])

    def _branch(self, branch: StateBranch, several: bool) -> Iterator[str]:
        known = self._ids[branch.name, ""]
        attributes = {"id": known, **dict(exact("smsl:name", branch.name))}
        for key, state in (("initial", branch.initial), ("smsl:activating", branch.activating)):
            if state in branch.table:
                attributes[key] = self._ids[branch.name, state]
        yield tag("state", attributes)
        yield f"    {text_element('smsl:branch', as_json(branch_carried(branch)))}"
        events = Identifiers()
        names = {name: events.of(name, "e") for name in branch.operation_names}
        before = f"{known}." if several else ""
        for state in branch.table:
            heed()
            yield from self._state(branch, state, {n: before + e for n, e in names.items()})
        yield "</state>"

    def _state(self, branch: StateBranch, state: str, events: dict[str, str]) -> Iterator[str]:
        known = self._ids[branch.name, state]
        attributes = {"id": known, **dict(exact("smsl:name", state))}
        content = []
        if carried := state_carried(branch, state):
            content.append(text_element("smsl:state", as_json(carried)))
        for name, target in branch.table[state].items():
            if target in branch.table:
                content.append(self._transition(branch, state, name, events[name]))
        if not content:
            yield f"    {tag('state', attributes, '/')}"
            return
        yield f"    {tag('state', attributes)}"
        yield from (f"        {line}" for line in content)
        yield "    </state>"

    def _transition(self, branch: StateBranch, state: str, name: str, event: str) -> str:
        target = self._ids[branch.name, branch.table[state][name]]
        attributes = {"event": event, "target": target, **dict(exact("smsl:name", name))}
        parts = [
            " || ".join(f"In('{self._ids[sb, one]}')" for sb, one in states) or "false"
            for states in required_states(self._blueprint, branch, state, name)
        ]
        if parts:
            cond = " && ".join(f"({one})" if len(parts) > 1 else one for one in parts)
            attributes |= {"cond": cond, "smsl:cond": cond}
        return tag("transition", attributes, "/")
