"""The menu of the facts of an SB, with the SBs that could expand each fact."""

from __future__ import annotations

from functools import partial

from PySide6.QtWidgets import QMenu

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.draw_verbs import DrawVerbs

MOST = 64
"""The menu offers this many facts at most."""


def fill_sub_sbs(session: Session, drawing: DrawVerbs, menu: QMenu) -> None:
    """Fill the menu with the facts of the SB that is shown and the SBs that could expand each."""
    branch = session.blueprint[session.branch]
    if not told_facts(branch):
        # As the panel of facts says: words are no facts, so there is none yet to be expanded.
        inner = menu.addMenu("A new fact")
        for name in _free(session, branch):
            inner.addAction(as_it_is(name), partial(drawing.attach_new_fact, name))
        inner.addAction("New State Branch", partial(drawing.attach_new_fact, None))
        return
    for digit in range(min(branch.num_facts, MOST)):
        inner = menu.addMenu(as_it_is(f"{digit}  {branch.fact_name(digit)}"))
        taken = branch.subs.get(digit)
        if taken is not None:
            inner.addAction(as_it_is(f"Expanded by {taken}")).setEnabled(False)
            continue
        for name in _free(session, branch):
            inner.addAction(as_it_is(name), partial(drawing.attach, digit, name))
        inner.addAction("New State Branch", partial(drawing.attach, digit, None))


def _free(session: Session, branch: StateBranch) -> list[str]:
    """The SBs that could expand a fact of ``branch``."""
    taken = {branch.name, *branch.subs.values()}
    return [name for name in session.blueprint.branches if name not in taken]
