"""The provider ``by-hand``: answers are files in a folder, and prompts are written beside them."""

from __future__ import annotations

import json
from pathlib import Path

from smsl_studio.errors import Place, ReadError, UsageError
from smsl_studio.generate.text.answers import LONGEST_ANSWER
from smsl_studio.generate.text.equipment import read_equipment_page
from smsl_studio.generate.text.expert_text import read_text
from smsl_studio.generate.text.functions import codes_of
from smsl_studio.generate.text.prompts import FILES, HIM, PM, RMM
from smsl_studio.generate.text.provider import StageAnswer, StageQuestion, Unanswered
from smsl_studio.generate.text.step_keys import unread
from smsl_studio.generate.text.step_numbers import numbered, unknown_numbers, without_sources
from smsl_studio.generate.text.step_reader import read_steps
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.inputs import read_ordinary

MOST_FILES = 1_000


class AnswerFolder:
    """A folder with answers. For an answer that is missing its prompt is written."""

    by_file = True
    attempts = 1
    name = "by hand"

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def answer(self, question: StageQuestion) -> StageAnswer:
        """Return what lies in the folder. ReadError for a file that cannot be read, Unanswered if
        there is none: then the prompt lies there."""
        stage = question.stage
        path = self.folder / FILES[stage]
        if stage == RMM:
            if not path.is_dir():
                self._ask(question)
            return StageAnswer(self._codes(path, question), self.name)
        if not path.exists():
            self._ask(question)
        text = _text_at(path)
        if stage == PM:
            page = read_text(text.encode(), str(path))
            for line in page.lines:
                if why := unread(line.text):
                    words = f"this line says nothing: {line.text.strip()[:100]}"
                    raise ReadError(words, Place(str(path), line.number, 1), why)
            steps = without_sources(read_steps([page]), page.file)
            for words in unknown_numbers(steps):
                advice = "Write on, again, start, or the number of a step of this page."
                raise ReadError(words, Place(str(path), 1, 1), advice)
            text = numbered(steps).model_dump_json(exclude_defaults=True)
        elif stage == HIM:
            try:
                text = json.dumps(read_equipment_page(text), ensure_ascii=False, default=str)
            except ValueError as error:
                raise ReadError(
                    f"the file is no TOML: {error}", Place(str(path), 1, 1), "Mend it."
                ) from None
        return StageAnswer(text, self.name)

    def _codes(self, folder: Path, question: StageQuestion) -> str:
        names = sorted(one.name for one in folder.iterdir() if one.suffix == ".py")[:MOST_FILES]
        files = [(name, _text_at(folder / name)) for name in names]
        return codes_of(files, question.matter.names).model_dump_json()

    def _ask(self, question: StageQuestion) -> None:
        self.folder.mkdir(parents=True, exist_ok=True)
        prompt = self.folder / f"{question.stage}.prompt.md"
        if prompt.is_symlink():
            raise UsageError(
                f"{prompt} is a link, and the prompt would be written into another file",
                advice="Move the link away.",
            )
        save_document(question.prompt, prompt)
        name = FILES[question.stage] + ("/" if question.stage == RMM else "")
        raise Unanswered(
            f"{self.folder / FILES[question.stage]} is missing: stage {question.stage}",
            f"Read {prompt}, write {name} beside it, and call this again.",
        )


def _text_at(path: Path) -> str:
    try:
        raw = read_ordinary(path, LONGEST_ANSWER).raw
        if len(raw) <= LONGEST_ANSWER:
            return raw.decode("utf-8-sig")
        reason = f"it is larger than {LONGEST_ANSWER:,} bytes"
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
    raise ReadError(
        f"the answer cannot be read: {reason}", Place(str(path), 1, 1), "Mend the file."
    )
