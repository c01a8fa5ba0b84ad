"""The file of the rules that a window shows, and the text that is not saved yet."""

from __future__ import annotations

import json
from pathlib import Path

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.errors import ReadError
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.files import read_content, save_document
from smsl_studio.studio.base.settings import Settings

ENDING = ".rules.toml"
_PLACE = "rule_drafts/"


class RulesFile:
    """A path, the text on the disk, and the unsaved text.

    An unsaved text is stored in the settings at every pause. So neither a closed window nor the end
    of the program takes it away. ``path`` is None before the first save.
    """

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self.path: Path | None = None
        self.saved = ""

    @property
    def name(self) -> str:
        """The name in the window."""
        return self.path.name if self.path is not None else f"untitled{ENDING}"

    def open(self, path: Path | None) -> tuple[str, bool]:
        """Take another file. Return its text, and whether that was not saved before.

        ReadError if the file cannot be read. Without a path it is a new one.
        """
        text = _text_of(path) if path is not None else ""
        self.path, self.saved = path, text
        kept = self._settings.text_of(self._place)
        return (kept, True) if kept and kept != text else (text, False)

    def keep(self, text: str) -> None:
        """Store a text that is not on the disk. A saved one needs no storing."""
        kept = "" if text == self.saved else text
        if self._settings.text_of(self._place) != kept:
            self._settings.store_text(self._place, kept)

    def save(self, text: str, path: Path) -> None:
        """Write the text, completely or not at all. SaveError if that is not possible."""
        save_document(text, path)
        self.keep(self.saved)
        self.path, self.saved = path, text
        self.keep(text)

    @property
    def _place(self) -> str:
        return _PLACE + (sha256_hex(str(self.path).encode())[:32] if self.path else "new")


def _text_of(path: Path) -> str:
    try:
        return read_content(path).raw.decode("utf-8")
    except UnicodeDecodeError:
        raise ReadError(
            f"{path.name} is no text in UTF-8", advice="Choose a file of rules."
        ) from None


def first_text(branch: StateBranch | None) -> str:
    """Return rules to begin with: the facts of an SB with a free start, or those of a lamp."""
    if branch is None or branch.shape.opaque or not branch.table or not branch.num_facts:
        return LAMP
    facts = [
        f"    {{name = {_quoted(branch.fact_name(digit))}, values = {_quoted(values)}}},"
        for digit, values in enumerate(map(list, branch.alphabet))
    ]
    ends = [
        f"{word} = {_quoted(list(branch.facts(state)))}"
        for word, state in (("start", branch.initial), ("goal", branch.activating))
        if state in branch.table
    ]
    lines = [f"sb = {_quoted(branch.name)}", "facts = [", *facts, "]", *ends, "", *_example(branch)]
    return "\n".join(lines) + "\n"


def _quoted(value: str | list[str]) -> str:
    """Return a text or a list of texts as TOML has it."""
    return json.dumps(value, ensure_ascii=False)


def _example(branch: StateBranch) -> tuple[str, ...]:
    """Return an example of a rule: the first fact takes its last value."""
    fact, value = _quoted(branch.fact_name(0)), branch.alphabet[0][-1]
    return (
        "# One rule for each kind of operation: where it may begin, and what it changes.",
        "# This one is an example. Learn writes the rules that make the drawing.",
        "[[rule]]",
        'operation = "example"',
        f"cases = [{{when = {_quoted(f'0 != {value}')}, set = {{{fact} = {_quoted(value)}}}}}]",
    )


LAMP = """\
# What is there, where it begins, where it shall end, and what each operation changes.
sb = "LAMP"
facts = [{name = "lamp", values = ["0", "1"]}]
start = ["0"]
goal = ["1"]

[[rule]]
operation = "switch_on"
cases = [{when = "lamp = 0", set = {lamp = "1"}}]
"""
