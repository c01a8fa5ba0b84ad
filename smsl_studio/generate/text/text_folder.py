"""The texts and PDFs of a folder, as sources that may be cited. Whatever the folder holds, reading
it is bounded; what is left out is told."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from smsl_studio.errors import Place, ReadError
from smsl_studio.generate.text.expert_text import ExpertText, text_at
from smsl_studio.stop import heed

SUFFIXES = (".txt", ".md", ".markdown", ".text", ".pdf")
MOST_ENTRIES = 50_000
MOST_FILES = 5_000
MOST_CHARACTERS = 10_000_000
"""So many characters of all texts together are searched: about five thousand pages."""
MOST_PDFS = 300
MOST_BAD_PDFS = 3
"""After so many PDFs that cannot be read no further one is opened: each may take its limit."""
LONGEST = 300.0
"""The wall time (s) after which no further PDF is opened."""
DEEPEST = 12
_MOST_TOLD = 20


@dataclass
class TextFolder:
    """The texts of a folder, in the order of their names, and sentences about what was left out."""

    texts: list[ExpertText] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)

    def leave_out(self, sentence: str) -> None:
        """Tell that something was left out. Of many sentences the first ones are kept."""
        if len(self.left_out) < _MOST_TOLD:
            self.left_out.append(sentence)
        elif len(self.left_out) == _MOST_TOLD:
            self.left_out.append("and more files, which are not listed here")


def read_folder(folder: Path) -> TextFolder:
    """Read the texts below a folder. Hidden entries and links are passed over. ReadError if there
    is no text that can be read."""
    found = TextFolder()
    characters = pdfs = bad = 0
    end = time.monotonic() + LONGEST
    for count, path in enumerate(_files(folder, found)):
        heed()
        name = path.relative_to(folder).as_posix()
        if count >= MOST_FILES:
            found.leave_out(f"{name} and later ones: there are more than {MOST_FILES:,} texts")
            break
        is_pdf = path.suffix.lower() == ".pdf"
        if is_pdf:
            pdfs += 1
            if pdfs > MOST_PDFS or bad >= MOST_BAD_PDFS or time.monotonic() > end:
                found.leave_out(f"{name}: too many PDFs, or too many that cannot be read")
                continue
        try:
            text = text_at(path, name)
        except ReadError as error:
            bad += is_pdf
            found.leave_out(f"{name}: {error.sentence}")
            continue
        characters += sum(len(line.text) for line in text.lines)
        if characters > MOST_CHARACTERS:
            words = f"there are more than {MOST_CHARACTERS:,} characters"
            found.leave_out(f"{name} and later ones: {words}")
            break
        found.texts.append(text)
    if not found.texts:
        words = "the folder holds no text that can be read"
        more = f" ({'; '.join(found.left_out[:3])})" if found.left_out else ""
        advice = "Put texts (.txt, .md) or PDFs into it."
        raise ReadError(words + more, Place(str(folder), 1, 1), advice)
    return found


def _files(folder: Path, found: TextFolder, depth: int = 0) -> Iterator[Path]:
    """Yield the texts below a folder, those of a folder before its subfolders."""
    try:
        with os.scandir(folder) as entries:
            listed: list[tuple[str, bool]] = []
            for entry in entries:
                if len(listed) >= MOST_ENTRIES:
                    found.leave_out(f"{folder.name}: it holds more than {MOST_ENTRIES:,} entries")
                    break
                if not entry.name.startswith(".") and not entry.is_symlink():
                    listed.append((entry.name, entry.is_dir(follow_symlinks=False)))
    except OSError as error:
        found.leave_out(f"{folder.name}: {error.strerror or error}")
        return
    for name, is_folder in sorted(listed):
        if not is_folder and name.lower().endswith(SUFFIXES):
            yield folder / name
    for name, is_folder in sorted(listed):
        if is_folder and depth < DEEPEST:
            yield from _files(folder / name, found, depth + 1)
