"""Bypasses: an edge with ``subs: load`` sets the facts of its sub-SBs by its own function.

No operation of these sub-SBs is carried out then. The run says so before it uses such an edge.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edges import Edge
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.people.questions import title_of
from smsl_studio.dispatch.route.course import Course
from smsl_studio.runlog.events import SubsBypassed


class Bypasses:
    """The bypasses of one run, and which of them were told."""

    def __init__(self, run: LiveRun, course: Course) -> None:
        notes = (note for branch in run.blueprint for note in branch.notes.operations.values())
        self._any = any(note.subs == "load" for note in notes)
        self._run, self._course = run, course
        self._told: set[Address] = set()

    def tell(self, addresses: Iterable[Address], again: bool = False) -> None:
        """Tell the bypasses among some edges, once each. With ``again`` tell them a second time
        too.
        """
        run = self._run
        for edge in self._among(addresses):
            if again or edge.address not in self._told:
                self._told.add(edge.address)
                subs, sentence = self._subs(edge), self._sentence(edge)
                told = SubsBypassed(t=run.time, address=str(edge), subs=subs, sentence=sentence)
                run.emit(told)

    def sentences(self, addresses: Iterable[Address]) -> tuple[str, ...]:
        """Return the sentences about the bypasses among some edges."""
        return tuple(self._sentence(edge) for edge in self._among(addresses))

    def _among(self, addresses: Iterable[Address]) -> Iterator[Edge]:
        if self._any:
            for address in dict.fromkeys(addresses):
                edge = self._course.edge(address)
                if edge is not None and edge.load:
                    yield edge

    def _digits(self, edge: Edge) -> list[tuple[int, str]]:
        changed = {*edge.falls, *edge.rises}
        return [one for one in self._run.hierarchy.subs[edge.branch] if one[0] in changed]

    def _subs(self, edge: Edge) -> tuple[str, ...]:
        known = self._run.hierarchy
        return tuple(
            dict.fromkeys(name for _, sub in self._digits(edge) for name in known.tree(sub))
        )

    def _sentence(self, edge: Edge) -> str:
        blueprint = self._run.blueprint
        branch = blueprint[edge.branch]
        facts = " and ".join(branch.fact_name(digit) for digit, _ in self._digits(edge))
        return (
            f"Goes by {title_of(blueprint, edge.address)}: it sets {facts} of {branch.name} by "
            f"itself, and no operation of {' and '.join(self._subs(edge))} is carried out."
        )
