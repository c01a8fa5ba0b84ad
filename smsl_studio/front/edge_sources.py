"""Who proposes edges: the reader of the library, a folder of a person, kept answers, a server."""

from __future__ import annotations

import threading
from pathlib import Path

from smsl_studio.errors import StudioError, UsageError, did_you_mean
from smsl_studio.front.edge_answer import LONGEST, STAGE
from smsl_studio.generate.text.kept_answers import AnsweredQuestion, read_kept
from smsl_studio.generate.text.provider import (
    Matter,
    StageAnswer,
    StageProvider,
    StageQuestion,
    Unanswered,
)
from smsl_studio.generate.text.providers import BY_HAND, READER, REPLAY
from smsl_studio.generate.text.server_provider import AnswerServer
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.inputs import read_ordinary
from smsl_studio.stop import heed

SECONDS = 60.0
"""The wall time (s) that a run waits for an answer."""
LOOK = 0.02
CHOICE = f"Choose {READER}, {BY_HAND}:DIR, {REPLAY}FILE, or the base URL of a server."


class EdgeFolder:
    """A folder in which a person puts answers: ``edges-1.json`` for the first question of a run.
    For an answer that is missing its prompt is written there."""

    by_file = True
    attempts = 1
    name = "by hand"

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def answer(self, question: StageQuestion) -> StageAnswer:
        """Return what lies in the folder. Unanswered if there is none, or if it cannot be
        read."""
        path = self.folder / f"{STAGE}-{question.attempt}.json"
        if not path.exists():
            self.folder.mkdir(parents=True, exist_ok=True)
            prompt = path.with_suffix(".prompt.md")
            save_document(question.prompt, prompt)
            raise Unanswered(f"{path.name} is missing: read {prompt.name} and write it")
        try:
            raw = read_ordinary(path, LONGEST).raw
            return StageAnswer(raw[: LONGEST + 1].decode("utf-8-sig"), self.name)
        except (OSError, UnicodeDecodeError) as error:
            reason = getattr(error, "strerror", None) or "it is not UTF-8"
            raise Unanswered(f"{path.name} cannot be read: {reason}") from None


def source_named(name: str) -> StageProvider | None:
    """Return who answers, None for the reader. UsageError for an unknown name, ReadError for kept
    answers that cannot be read."""
    if name == READER:
        return None
    if name.startswith(f"{BY_HAND}:") and name != f"{BY_HAND}:":
        return EdgeFolder(Path(name.partition(":")[2]))
    if name.startswith(REPLAY):
        return read_kept(name.removeprefix(REPLAY))
    if "://" in name:
        return AnswerServer(name, SECONDS)
    raise UsageError(
        f"{name!r} proposes no edges", advice=did_you_mean(name, (READER, BY_HAND)) or CHOICE
    )


def source_words(name: str) -> str:
    """Return the name of a provider for the record, which has no path and no address."""
    return "server" if "://" in name else name.partition(":")[0]


class AskedSource:
    """Asks a provider in a thread of its own, so that a stop never waits for an answer.

    ``answered`` are all questions with their answers. If the wait is called off and the same
    question is asked again, the wait goes on.
    """

    def __init__(self, provider: StageProvider) -> None:
        self.answered: list[AnsweredQuestion] = []
        self._provider = provider
        self._open: tuple[StageQuestion, threading.Thread, list[StageAnswer | Exception]] | None
        self._open = None

    def ask(self, prompt: str, number: int) -> StageAnswer:
        """Return the answer. Unanswered or StudioError if there is none. Stopped if the run must
        stop."""
        question = StageQuestion(STAGE, prompt, number, Matter(()))
        if self._open is None or self._open[0] != question:
            box: list[StageAnswer | Exception] = []
            thread = threading.Thread(target=self._answer, args=(question, box), daemon=True)
            self._open = question, thread, box
            thread.start()
        _, thread, box = self._open
        while thread.is_alive():
            heed()
            thread.join(LOOK)
        self._open = None
        found = box[0]
        if isinstance(found, Exception):
            raise found
        self.answered.append(AnsweredQuestion(question, found))
        return found

    def _answer(self, question: StageQuestion, box: list[StageAnswer | Exception]) -> None:
        try:
            box.append(self._provider.answer(question))
        except (Unanswered, StudioError) as error:
            box.append(error)
        except Exception as error:  # an answer must not end the run, whatever it is
            box.append(Unanswered(f"the provider failed: {type(error).__name__}"))
