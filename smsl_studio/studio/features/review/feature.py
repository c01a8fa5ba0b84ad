"""The mode Review as a feature: its page, its actions, and what it asks of its neighbours."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer

from smsl_studio.errors import StudioError
from smsl_studio.front.approval_badge import UNINSPECTED, ApprovalWords
from smsl_studio.inspection.review.review import ReviewComment
from smsl_studio.inspection.review.reviewed import ReviewedLine
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.feature import Control, Feature, KeyList, Page, Shell, whole
from smsl_studio.studio.base.file_dialogs import ask_to_open, ask_to_save
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.features.review.asked_findings import asked_findings
from smsl_studio.studio.features.review.drafts import REPLY, ReviewDraft, ReviewDrafts
from smsl_studio.studio.features.review.open_review import OpenReview
from smsl_studio.studio.running.persons import Persons
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.review.page import ReviewPage
    from smsl_studio.studio.features.review.sign_dialog import SignDialog
    from smsl_studio.studio.features.review.watch_column import WatchColumn
    from smsl_studio.studio.running.run_session import RunSession

Words = tuple[tuple[str, ...], tuple[str, ...]]
CHANGED = "The procedure has changed meanwhile. Read it again before you sign"
READ_ONLY = "Read only, nothing here changes the procedure"
PAPERS = "PDF (*.pdf);;HTML (*.html)"
ANSWERS = "Answers of a review (*.review.json);;All files (*)"
KEYS: tuple[KeyList, ...] = (
    (
        "Review",
        (
            ("One line on, one line back", "Down, Up"),
            ("Next line without an answer", "Right"),
            ("Approve the line, or take it back", "Y"),
            ("Comment on the line", "C"),
            ("Keep what is written; leave it", "Ctrl+Enter, Esc"),
            ("Watch the step run", "W"),
            ("Larger, smaller, usual text", "Ctrl++, Ctrl+-, Ctrl+0"),
        ),
    ),
)


class ReviewFeature(Feature):
    """Review. The page is made when the mode is first shown.

    Nothing here edits the blueprint. The shell sets the functions that reach other features.
    """

    keys = KEYS

    def __init__(self, parts: WindowParts, shell: Shell, persons: Persons) -> None:
        self._parts, self._shell, self._tokens = parts, shell, parts.tokens
        self.review = OpenReview(parts.session, parts.files, persons, parts.window)
        self.review.changed.connect(self._changed)
        self.review.kept.connect(self._kept)
        self.review.refused.connect(self._refuse)
        self.drafts = ReviewDrafts(parts.settings, lambda: str(parts.files.path or ""))
        parts.session.opened.connect(self._take_drafts)
        parts.session.blueprint_changed.connect(self._leave_signing)
        parts.files.changed.connect(self._follow_file)
        self._beside = Beside(parts.window)
        self._approval: ApprovalWords = UNINSPECTED
        self._asked: tuple[tuple[Finding, ReviewComment], ...] = ()
        self._saved, self._found, self._blocked = "", 0, ""
        parts.inspector.found.connect(self._follow_findings)
        self.signing: SignDialog | None = None
        """The dialog in which somebody signs, after it was opened for the first time."""
        self.signed: Callable[[], object] = lambda: None
        self.change_person: Callable[[], object] = lambda: None
        self.play: Callable[[tuple[str, ...], str], str] = lambda starts, goal: ""
        self.run: Callable[[], RunSession] | None = None
        self.asked_changed: Callable[[], object] = lambda: None
        self.words_changed: Callable[[], object] = lambda: None
        self.ask_paper: Callable[[str], str] = self._ask_paper
        self.part = LatePart(self._make)
        self.watching = LatePart(self._make_watch)
        self.pages = {"review": self._page}

    @property
    def page(self) -> ReviewPage:
        """The body of the mode."""
        return self.part()

    @property
    def words(self) -> Words:
        """The texts of the status line."""
        return (READ_ONLY, *((f"Answers saved {self._saved}",) if self._saved else ())), ()

    def actions(self) -> tuple[Action, ...]:
        """The rows of the menus View and Blueprint."""
        return (
            Action("mode_review", "Review mode", lambda: self._shell.set_mode("review"), "View", "",
                   ("Ctrl+4",), checked=lambda: self._shell.mode == "review", short="Review",
                   tip="Read the procedure as text, answer each line, sign"),
            Action("add_answers", "Add answers from a file…", self.add_answers, "Blueprint", "", (),
                   lambda: self._parts.files.path is not None, section=4,
                   tip="Merge the answers that somebody gave on another computer"),
        )  # fmt: skip

    def asked(self) -> tuple[Finding, ...]:
        """The open comments as findings of the drawing."""
        return tuple(finding for finding, _ in self._asked)

    def answer(self, finding: Finding) -> None:
        """Open the dialog in which an engineer answers a comment."""
        from smsl_studio.studio.features.review.comment_dialog import CommentDialog
        from smsl_studio.studio.features.review.review_style import review_sheet

        comment = next((one for own, one in self._asked if own == finding), None)
        if comment is None:
            return
        sheet = review_sheet(self._tokens, 1.0)
        dialog = CommentDialog(comment, sheet, self._parts.window)
        dialog.answered.connect(self.review.reply)
        dialog.line_wanted.connect(self.show_comment)
        dialog.begun.connect(self._begin)
        dialog.open()

    def show_comment(self, comment: ReviewComment) -> None:
        """Show the line of a comment in Review."""
        self._shell.set_mode("review")
        self.page.show_comment(comment.entry.id)

    def add_answers(self) -> None:
        """Ask for a file with answers, and merge it."""
        path = self._parts.files.path
        folder = str(path.parent) if path is not None else ""
        chosen = ask_to_open(self._parts.window, "Add answers from a file", folder, ANSWERS)
        if chosen:
            self.add_from(chosen)

    def add_from(self, path: str) -> None:
        """Merge the answers in a file, and say how many are new."""
        new = self.review.add_from(path)
        self._parts.toast.say(f"{new} answer{'' if new == 1 else 's'} added")

    def show_approval(self, said: ApprovalWords) -> None:
        """Show who has signed."""
        self._approval = said
        if self.part.made is not None:
            self.part.made.show_approval(said)

    def print(self) -> None:
        """Ask for a file, and write the report there in a second thread."""
        path = self._parts.files.path
        suggested = str(path.with_suffix(".pdf")) if path is not None else "procedure.pdf"
        chosen = self.ask_paper(suggested)
        if not chosen:
            return
        blueprint, record = self._parts.session.blueprint, None
        if path is not None and Path(f"{path}.record.json").exists():
            record = f"{path}.record.json"

        def write() -> str:
            """Write the report; return what is told about it."""
            from smsl_studio.front.reports import report

            try:
                report(blueprint, chosen, record)
            except StudioError as error:
                return refusal_words(error)
            return f"The reading was written to {Path(chosen).name}"

        self._beside.do(write, self._parts.toast.say)

    def sign(self, rejects: bool) -> None:
        """Open the dialog for a signature, if nothing is open. A rejection is always possible."""
        from smsl_studio.studio.features.review.sign_dialog import SignDialog

        seen = self.review.seen
        if seen is None or (not rejects and (self._blocked or seen.why_not_signed())):
            return
        if self._parts.files.unsaved:
            self._parts.toast.say("Save the procedure first. A signature is for what is saved")
            return
        author = self.review.author
        blueprint = self._parts.session.blueprint
        conditions = [one.condition for one in self._approval.refusals if one.condition]
        self.signing = SignDialog(
            blueprint, author.person, self._parts.window, rejects, conditions, author.role
        )
        self.signing.signed.connect(lambda _: self._signed())
        self.signing.open()

    def _leave_signing(self) -> None:
        """Close the dialog for a signature, because it would sign what is no longer shown."""
        if self.signing is not None and self.signing.isVisible():
            self.signing.reject()
            # Not earlier: a message is taken away when a file is opened.
            QTimer.singleShot(0, self._parts.window, lambda: self._parts.toast.warn(CHANGED))

    def _follow_findings(self, findings: Sequence[Finding]) -> None:
        """Tell first what nobody can sign away, before somebody reads all lines."""
        errors = sum(one.severity is Severity.ERROR for one in findings)
        words = counted(errors, "error blocks", "errors block")
        self._blocked = f"{words} approval. Findings in Draw has the reasons." if errors else ""
        page = self.part.made
        if page is not None and page.blocked != self._blocked:
            page.blocked = self._blocked
            page.refresh()

    def watch(self, one: ReviewedLine) -> None:
        """Play a step beside the text."""
        column = self.watching()
        page, line = self.page, one.line
        page.right.setCurrentWidget(column)
        edge = line.about[0] if line.about else None
        branch = self._parts.session.blueprint.branches.get(edge.branch) if edge else None
        if edge is None or branch is None or not edge.operation:
            column.show_none(line.heading, "This line is no step, so there is nothing to play.")
            return
        starts = tuple(map(str, line.starts)) or (f"{edge.branch}/{edge.state}",)
        goal = f"{edge.branch}/{branch.table[edge.state][edge.operation]}"
        why = self.play(starts, goal)
        if why:
            column.show_none(line.heading, why)
        else:
            column.show_step(line.heading, edge.branch)

    # What the shell needs.

    def control(self, name: str) -> Control | None:
        """The parts of the page."""
        page = self.part.made
        if page is None:
            return None
        own = {"review_sign": page.side.sign, "review_lines": page.reading}
        return whole(own[name]) if name in own else None

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)
        if self.watching.made is not None:
            self.watching.made.set_tokens(tokens)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.review.stop()
        self._beside.stop()
        if self.watching.made is not None:
            self.watching.made.stop()

    def _page(self) -> Page:
        return Page(self.page, self.page, self.page.bar)

    def _make(self) -> ReviewPage:
        from smsl_studio.studio.features.review.page import ReviewPage

        page = ReviewPage(self.review, self.drafts, self._parts.settings, self._tokens)
        page.sign_wanted.connect(self.sign)
        page.watch_wanted.connect(self.watch)
        page.print_wanted.connect(self.print)
        page.bar.person_wanted.connect(self._change_person)
        page.blocked = self._blocked
        page.show_approval(self._approval)
        return page

    def _make_watch(self) -> WatchColumn:
        from smsl_studio.studio.features.review.watch_column import WatchColumn

        assert self.run is not None
        column = WatchColumn(self._parts.session, self.run(), self._tokens)
        column.left.connect(lambda: self.page.right.setCurrentWidget(self.page.side))
        self.page.right.addWidget(column)
        return column

    def _begin(self, comment: ReviewComment, text: str) -> None:
        """Take an answer that was begun in a dialog along to the line."""
        one, person = comment.entry, self.review.author.person
        self.drafts.put(
            ReviewDraft(REPLY, person, one.line, one.section, one.heading, one.about, one.id, text)
        )

    def _take_drafts(self) -> None:
        self.drafts.load()
        self._found = len(self.drafts.begun(self.review.author.person))

    def _follow_file(self) -> None:
        self.drafts.follow()
        # Not earlier: a message is taken away when a file is opened.
        many, self._found = self._found, 0
        if many:
            texts = "A text is" if many == 1 else f"{many} texts are"
            self._parts.toast.say(f"{texts} begun in Review and not kept yet")

    def _changed(self) -> None:
        found = asked_findings(self._parts.session.blueprint, self.review.review)
        if found != self._asked:
            self._asked = found
            self.asked_changed()

    def _kept(self) -> None:
        self._saved = datetime.now().astimezone().strftime("%H:%M")
        self.words_changed()

    def _signed(self) -> None:
        self._parts.toast.say("Signed. The record stands beside the file")
        self.signed()
        self.review.read_again()

    def _change_person(self) -> None:
        """Ask who reads. Afterwards the keys go to the line again, not to the button."""
        self.page.take_hand()
        self.change_person()

    def _refuse(self, error: StudioError) -> None:
        self._parts.toast.refuse(error)

    def _ask_paper(self, suggested: str) -> str:
        chosen, kind = ask_to_save(self._parts.window, "Print or save as PDF", suggested, PAPERS)
        if chosen and not Path(chosen).suffix:
            chosen += ".html" if "html" in kind else ".pdf"
        return chosen
