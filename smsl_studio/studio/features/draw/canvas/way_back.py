"""WayBack leads into a sub-SB and back to its base, and tells where one has come to."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.overlays.breadcrumb import chain
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session


class WayBack:
    """Shows another SB for the canvas. What was selected in a base is selected again on return."""

    def __init__(self, session: Session, canvas: Canvas) -> None:
        self._session, self._canvas = session, canvas
        self._chosen: dict[str, tuple[Address, ...]] = {}
        """What was selected last in each SB."""
        session.selection_changed.connect(self._remember)
        session.opened.connect(self._chosen.clear)
        canvas.enter_wanted.connect(self.show)
        canvas.leave_wanted.connect(self.leave)

    def show(self, branch: str) -> None:
        """Show an SB: a sub-SB, or one on the way from the top to here."""
        session = self._session
        if branch not in session.blueprint.branches or branch == session.branch:
            return
        back = branch in chain(session.blueprint, session.branch)
        chosen = self._chosen.get(branch, ()) if back else ()
        session.show_branch(branch)
        if chosen:
            session.select(chosen)
            for one in session.selection[:1]:
                self._canvas.reveal(one, smooth=False)
        announce(self._canvas, self._words)

    def leave(self) -> None:
        """Show the base SB; at the top a sentence says that there is none."""
        session = self._session
        bases = session.blueprint.bases.get(session.branch)
        if bases:
            self.show(bases[0][0])
        elif session.branch:
            self._canvas.say(f"{session.branch} is the top: no fact has it as its sub-SB.")

    def _remember(self, selection: tuple[Address, ...]) -> None:
        if selection:
            self._chosen[selection[0].branch] = selection
        else:
            # An SB that is left was replaced before its selection ends, so it is not this one.
            self._chosen.pop(self._session.branch, None)

    @property
    def _words(self) -> str:
        """Which SB is shown, how large it is, and what it expands."""
        blueprint, name = self._session.blueprint, self._session.branch
        words = f"{name}, {counted(len(blueprint[name].table), 'state')}"
        base, digit = next(iter(blueprint.bases.get(name, ())), ("", 0))
        if not base:
            return f"{words}."
        return f"{words}. It expands {blueprint[base].fact_name(digit)} of {base}."
