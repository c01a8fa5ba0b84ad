"""What lies beside a blueprint and tells of its design cycle: texts, the files of the chain, code,
runs, campaigns. All of it comes from outside, so sizes and numbers are bounded, and what cannot be
read is passed over with its reason."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.blueprint.project import is_below, project_of, real_path
from smsl_studio.errors import StudioError
from smsl_studio.generate.code.templates import BY
from smsl_studio.generate.text.answers import AnswerFault, fitted
from smsl_studio.generate.text.chain import KEPT
from smsl_studio.generate.text.equipment import NeededEquipment, read_equipment_page
from smsl_studio.generate.text.expert_text import ExpertText, text_at
from smsl_studio.generate.text.prompts import FILES, HIM
from smsl_studio.smsl.inputs import read_ordinary
from smsl_studio.stop import heed

Json = Any
Got = TypeVar("Got")
MOST_FILES = 200
"""So many files or folders beside the blueprint are looked at."""
LARGEST = 16 << 20
LONGEST_HEAD, LONGEST_END = 1 << 20, 4096
"""A log is read at its head and at its end only (bytes)."""
_CODE_HEAD = 4096
_CLOSURE = re.compile(r'(?:CLOSURE|closure_digest) = "([0-9a-f]{64})"')


@dataclass(frozen=True)
class TextBeside:
    """A text of the consultation, by its name. Without ``text``, ``lacks`` says why."""

    name: str
    path: Path | None = None
    text: ExpertText | None = None
    lacks: str = ""


@dataclass(frozen=True)
class CodeBeside:
    """A program that was made of a blueprint: its folder, the digest of that, its files."""

    folder: Path
    closure: str
    files: int


@dataclass(frozen=True)
class RunBeside:
    """The log of a run: its file, the digest of its blueprint, the world, how it ended."""

    file: Path
    closure: str
    world: str
    outcome: str


@dataclass(frozen=True)
class CampaignBeside:
    """The result of a campaign, which does not say for which version it was."""

    file: Path
    runs: int
    reached: int
    digest: str


class DigestedText(BaseModel):
    """A text of which answers were made."""

    model_config = ConfigDict(extra="ignore", frozen=True)
    file: Annotated[str, Field(max_length=300)]
    digest: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]


class _KeptAnswer(BaseModel):
    model_config = ConfigDict(extra="ignore", frozen=True)
    stage: Annotated[str, Field(max_length=20)]
    model: Annotated[str, Field(max_length=300)]


class KeptHead(BaseModel):
    """Of ``answers.json``: the texts with their digests, and who answered at which stage."""

    model_config = ConfigDict(extra="ignore", frozen=True)
    texts: Annotated[tuple[DigestedText, ...], Field(max_length=1000)] = ()
    hardware: Annotated[tuple[DigestedText, ...], Field(max_length=1000)] = ()
    answers: Annotated[tuple[_KeptAnswer, ...], Field(max_length=1000)] = ()


class KeptVerdict(BaseModel):
    """The verdict of a requirement, as ``requirements.json`` has it."""

    model_config = ConfigDict(extra="ignore", frozen=True)
    kind: Annotated[str, Field(max_length=100)]
    name: Annotated[str, Field(max_length=1000)]
    verdict: Annotated[str, Field(max_length=100)]
    reason: Annotated[str, Field(max_length=10_000)] = ""


class _Verdicts(BaseModel):
    listed: Annotated[tuple[KeptVerdict, ...], Field(max_length=10_000)]


def found_texts(
    names: Sequence[str], known: Sequence[Path], folder: Path
) -> tuple[TextBeside, ...]:
    """Return the texts of these names: where the notes say, else in the folder of the blueprint.
    Further known files come behind them. One that lies too far away is not read (``is_near``)."""
    by_name = {one.name: one for one in known}
    wanted = list(dict.fromkeys((*names, *by_name)))[:MOST_FILES]
    return tuple(
        _text(name, by_name.get(name, folder / Path(name).name), folder) for name in wanted
    )


def is_near(path: Path, folder: Path) -> bool:
    """Return whether a file that notes beside a blueprint name may be read: it lies in the project
    of the blueprint, or just above its folder, where a text is by itself. Links are resolved."""
    real, own = real_path(str(path)), real_path(str(folder))
    project = project_of(str(folder / "blueprint"))
    return is_below(real, project) or Path(real).parent == Path(own).parent


def too_far(name: str) -> str:
    """Return why a file is not read."""
    return f"{name[:300]} lies outside the project and is not read"


def _text(name: str, path: Path, folder: Path) -> TextBeside:
    heed()
    if not is_near(path, folder):
        return TextBeside(name, None, None, too_far(name))
    try:
        return TextBeside(name, path, _text_at(path, _stamp(path)))
    except StudioError as error:
        if _stamp(path) is None:
            return TextBeside(name, None, None, f"{name[:300]} is not here")
        return TextBeside(name, path, None, f"{name}: {error.sentence}")


@lru_cache(maxsize=64)
def _text_at(path: Path, stamp: object) -> ExpertText:
    """Return the text of a file. One that has not been written since is not read again, because a
    PDF takes a process of its own."""
    return text_at(path)


def _stamp(path: Path) -> object:
    try:
        seen = path.stat()
    except (OSError, ValueError):
        return None
    return seen.st_ino, seen.st_mtime_ns, seen.st_size


def kept_head(folder: Path) -> KeptHead | None:
    """Return what ``answers.json`` says; None if there is none that can be read."""
    return _read(folder / KEPT, lambda raw: KeptHead.model_validate_json(raw))


def needed_equipment(folder: Path) -> NeededEquipment | None:
    """Return what ``him.toml`` says; None if there is none that can be read."""

    def read(raw: bytes) -> NeededEquipment:
        return fitted(NeededEquipment, read_equipment_page(raw.decode("utf-8-sig")))

    return _read(folder / FILES[HIM], read)


def kept_verdicts(folder: Path) -> tuple[KeptVerdict, ...]:
    """Return the verdicts of ``requirements.json``."""

    def read(raw: bytes) -> tuple[KeptVerdict, ...]:
        return _Verdicts.model_validate({"listed": json.loads(raw)}).listed

    return _read(folder / "requirements.json", read) or ()


def found_codes(folder: Path) -> Iterator[CodeBeside]:
    """Yield the programs in folders of ``folder``, as ``generate code`` writes them."""
    for place in _inside(folder):
        for package in _inside(place):
            for name in ("blueprint.py", "blueprint.cpp"):
                head = _head(package / name, _CODE_HEAD)
                said = _CLOSURE.search(head)
                if said is not None and BY in head:
                    files = sum(1 for one in package.rglob("*") if one.suffix in _CODE)
                    yield CodeBeside(place, said[1], files)


_CODE = (".py", ".cpp", ".hpp")


def found_runs(folder: Path) -> Iterator[RunBeside]:
    """Yield the logs of runs in a folder."""
    for path in _inside(folder):
        if path.suffix != ".jsonl":
            continue
        with suppress(OSError, ValueError, KeyError, TypeError, RecursionError):
            first = json.loads(_head(path, LONGEST_HEAD).partition("\n")[0])
            if first["log"] == "smsl-run":
                world, closure = str(first["world"])[:100], str(first["digests"]["closure"])
                yield RunBeside(path, closure, world, _outcome(path))


def _outcome(path: Path) -> str:
    """Return how a run ended, ``goal_reached`` for example; empty if it did not end."""
    with path.open("rb") as file:
        file.seek(0, 2)
        file.seek(max(0, file.tell() - LONGEST_END))
        end = file.read(LONGEST_END).decode("utf-8", "replace")
    found = re.findall(r'"event":"run_finished"[^\n]*?"reason":"([a-z_]{1,40})"', end)
    return found[-1] if found else ""


def found_campaigns(folder: Path) -> Iterator[CampaignBeside]:
    """Yield the results of campaigns in a folder."""
    for path in _inside(folder):
        if path.suffix != ".json" or '"runs"' not in _head(path, 100):
            continue

        def read(raw: bytes, path: Path = path) -> CampaignBeside:
            values = json.loads(raw)
            runs, reached = int(values["runs"]), int(values["reached"])
            return CampaignBeside(path, runs, reached, str(values["digest"])[:64])

        found = _read(path, read)
        if found is not None:
            yield found


def _inside(folder: Path) -> list[Path]:
    heed()
    try:
        return sorted(folder.iterdir())[:MOST_FILES] if folder.is_dir() else []
    except OSError:
        return []


def _head(path: Path, most: int) -> str:
    try:
        return read_ordinary(path, most).raw[:most].decode("utf-8", "replace")
    except (OSError, ValueError):
        return ""


def _read(path: Path, how: Callable[[bytes], Got]) -> Got | None:
    try:
        raw = read_ordinary(path, LARGEST).raw
        return how(raw) if len(raw) <= LARGEST else None
    except (
        OSError, ValueError, OverflowError, KeyError, TypeError, RecursionError, AnswerFault,
        ValidationError,
    ):  # fmt: skip
        return None


def stamps_of(path: Path | None, texts: Sequence[Path | None]) -> tuple[object, ...]:
    """Return a value that changes when a file beside a blueprint, or a text, is written. Nothing is
    read."""
    beside = _inside(path.parent) if path is not None else []
    found: list[object] = []
    for one in (*beside, *texts):
        if one is not None:
            found.append((one, _stamp(one)))
    return tuple(found)
