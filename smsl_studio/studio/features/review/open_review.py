"""The review of the open file: its reading, and what people have answered."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import AddressError, StudioError, UsageError
from smsl_studio.front.reviews import keep_answers, review_in, review_of, waiting_answers
from smsl_studio.inspection.review.entry import ReviewEntry
from smsl_studio.inspection.review.review import Review, ReviewComment
from smsl_studio.inspection.review.review_author import ReviewAuthor
from smsl_studio.inspection.review.reviewed import ReviewedLine, ReviewedReading
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.running.persons import Persons

if TYPE_CHECKING:
    from smsl_studio.front.review_matter import ReviewMatter

NOTED = 6
"""At most so many elements of a line are shown in the notation of the paper."""


class OpenReview(QObject):
    """What is reviewed in this window. Every answer is written to the file at once.

    The reading is made in a second thread, when a page that shows it asks for it.
    """

    changed = Signal()
    """There is another reading, other answers, or another person."""
    kept = Signal()
    """An answer was written to the file."""
    refused = Signal(object)
    """StudioError: an answer is not possible, or could not be written."""

    def __init__(self, session: Session, files: Files, persons: Persons, parent: QObject) -> None:
        super().__init__(parent)
        self._session, self._files, self._persons = session, files, persons
        self._beside = Beside(self)
        self.matter: ReviewMatter | None = None
        self.seen: ReviewedReading | None = None
        """The reading with its answers, as this person sees them; None until it is made."""
        self.review = Review()
        self.fault = ""
        """Why there is no reading or no review, in words."""
        self._wanted: Blueprint | None = None
        self._file = ""
        session.blueprint_changed.connect(lambda *_: self._moved_on())
        files.changed.connect(self.look)
        persons.changed.connect(self._see)

    @property
    def author(self) -> ReviewAuthor:
        """The person who answers at this window."""
        me = self._persons.me
        return ReviewAuthor(self._persons.author() or me.name, me.role)

    @property
    def is_making(self) -> bool:
        """Whether the reading is being made."""
        return self._wanted is not None

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def look(self) -> None:
        """Read the answers of the file again: somebody else may have written them."""
        file = str(self._files.path or "")
        try:
            review = review_of(file) if file else Review()
        except StudioError as error:
            review, self.fault = Review(), f"{error} {error.advice}".strip()
        else:
            self.fault = ""
        self._file = file
        if review != self.review:
            self.review = review
        self._see()

    def read(self) -> None:
        """Make the reading of the drawing, unless it is there already or is being made."""
        if self.matter is None and self._wanted is not self._session.blueprint:
            self.read_again()

    def read_again(self) -> None:
        """Make the reading again, because somebody has signed. The present one stays until then."""
        blueprint = self._session.blueprint
        if blueprint.state_count:
            self._wanted = blueprint
            self._beside.drop()
            self._beside.do(partial(_matter_of, blueprint), partial(self._came, blueprint))
            self.changed.emit()

    def notation_of(self, about: tuple[Address, ...]) -> tuple[str, ...]:
        """Elements in the notation of the paper; those that are gone meanwhile are left out."""
        # Few readers ask for it.
        from smsl_studio.blueprint.notation import notation_of

        blueprint, found = self._session.blueprint, dict[str, None]()
        for address in about[:NOTED]:
            with suppress(AddressError):
                found.update(dict.fromkeys(notation_of(blueprint, str(address))))
        return tuple(found) or ("It is not in the drawing any more.",)

    def may_answer(self) -> bool:
        """Whether answers can be kept beside a file; tells the person if there is no file."""
        if self._files.path is None:
            self.refused.emit(_no_file())
        return self._files.path is not None

    def approve(self, one: ReviewedLine, note: str = "") -> bool:
        """Approve a line. An open point needs a remark. Like each answer, it returns whether the
        answer is kept."""
        return self._do(lambda: self.author.approve(self.review, one, note))

    def take_back(self, one: ReviewedLine) -> None:
        """Take the approval of a line back."""
        self._do(lambda: self.author.take_back(self.review, one))

    def comment(self, one: ReviewedLine, text: str) -> bool:
        """Write a comment on a line."""
        return self._do(lambda: self.author.comment(self.review, one, text))

    def reply(self, comment: ReviewComment, text: str) -> bool:
        """Answer a comment."""
        return self._do(lambda: self.author.reply(self.review, comment, text))

    def close(self, comment: ReviewComment) -> None:
        """Close a comment."""
        self._do(lambda: self.author.close(self.review, comment))

    def add_from(self, path: str) -> int:
        """Add the answers in another file, such as one from another computer. Return how many are
        new.
        """
        before = len(self.review.entries)
        self._do(lambda: review_in(path).entries)
        return len(self.review.entries) - before

    def _do(self, make: Callable[[], tuple[ReviewEntry, ...]]) -> bool:
        entries: tuple[ReviewEntry, ...] = ()
        try:
            if not self._files.path:
                raise _no_file()
            entries = make()
            if entries:
                self.review = self.review.merged(keep_answers(str(self._files.path), entries))
                self.kept.emit()
        except StudioError as error:
            self.refused.emit(error)
            self.look()
            # What could not be written yet waits in the journal, and comes with the next answer.
            kept = waiting_answers(str(self._files.path)).entries if self._files.path else ()
            return bool(entries) and set(entries) <= {*kept, *self.review.entries}
        self._see()
        return True

    def _moved_on(self) -> None:
        """Forget the reading, because the blueprint is another one now."""
        self._beside.drop()
        self._wanted, self.matter, self.seen = None, None, None
        if str(self._files.path or "") != self._file:
            self.look()
        else:
            self.changed.emit()

    def _came(self, blueprint: Blueprint, came: ReviewMatter | StudioError) -> None:
        if blueprint is not self._wanted:
            return
        self._wanted = None
        if isinstance(came, StudioError):
            self.fault = str(came)
            self.changed.emit()
        else:
            self.matter = came
            self._see()

    def _see(self) -> None:
        self.seen = None
        if self.matter is not None:
            self.seen = ReviewedReading(self.matter.reading, self.review, self.author.person)
        self.changed.emit()


def _no_file() -> UsageError:
    return UsageError(
        "Answers are kept beside the file, and this one has no file yet",
        advice="Save the procedure first.",
    )


def _matter_of(blueprint: Blueprint) -> ReviewMatter | StudioError:
    from smsl_studio.front.review_matter import review_matter

    try:
        return review_matter(blueprint)
    except StudioError as error:
        return error
