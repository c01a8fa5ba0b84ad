"""Unwritten: what holds in a blueprint by default, and is written when an edit would change it.

That is which state is activating, the facts of states, which value of a fact with a sub-SB counts
as on, and the places of states.
"""

from __future__ import annotations

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.document.places import Places


class Unwritten:
    """Keeps what held before an edit, and remembers which facts are only proposed.

    Facts in ``_states`` count only if every state has some. So a new state in such an SB gets
    values that no other state has. They are a proposal until somebody gives other ones.
    """

    def __init__(self, places: Places, blueprint: Blueprint) -> None:
        self._places = places
        self._drawn: tuple[str, ...] = ()
        """The SBs that the file had when it was opened or saved last, without those begun since."""
        self._proposed: dict[tuple[str, str], tuple[str, ...]] = {}
        self.follow(blueprint)

    def follow(self, blueprint: Blueprint) -> None:
        """Take this blueprint, which was opened or saved, as the one that is edited from here."""
        self._drawn = tuple(branch.name for branch in blueprint if len(branch.table) > 1)

    def written(self, before: Blueprint, after: Blueprint) -> Blueprint:
        """Return ``after`` with all that it would otherwise change unasked."""
        after = editing.keep_activating(before, after, self._drawn)
        after = editing.keep_facts(before, after)
        given = editing.give_facts(before, after)
        self._remember(before, after, given)
        return self._places.completed(before, editing.keep_on(before, given))

    def proposes(self, branch: StateBranch, state: str) -> bool:
        """Whether a state still has the facts that it was given when it was made."""
        return self._proposed.get((branch.name, state)) == branch.facts(state)

    def _remember(self, before: Blueprint, after: Blueprint, given: Blueprint) -> None:
        for branch in given:
            former = before.branches.get(branch.name)
            if former is None or former is branch:
                continue
            if branch is not after.branches[branch.name]:
                fresh = branch.table.keys() - former.table.keys()
                self._proposed |= {(branch.name, one): branch.facts(one) for one in fresh}
            elif self._proposed and len(former.table) == len(branch.table):
                for old, new in zip(former.table, branch.table, strict=True):
                    if old != new and (branch.name, old) in self._proposed:
                        self._proposed[branch.name, new] = self._proposed[branch.name, old]
