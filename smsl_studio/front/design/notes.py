"""``FILE.cycle.json``: what the design cycle of a blueprint must remember, because no other file
says it: where the texts lie, and for which digests something was tried or looked at.

It is beside the blueprint, is not signed, and comes from outside: what does not fit is refused.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, StringConstraints, ValidationError

from smsl_studio.errors import Place, ReadError
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.inputs import read_ordinary

SUFFIX = ".cycle.json"
MOST_DOUBTS = 100
LARGEST = 1 << 20
"""The largest size of the file (bytes)."""
_Short = Annotated[str, StringConstraints(max_length=300)]
_Doubt = Annotated[str, StringConstraints(max_length=1000)]
_Path = Annotated[str, StringConstraints(min_length=1, max_length=4096, pattern=r"^[^\x00]*$")]
MakerKind = Literal["person", "rules", "physics", "model"]
_Digest = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]


class StageNote(BaseModel):
    """Something that was done for a stage.

    ``of`` has the digests for which it was done, by the names of ``design.cycle``. ``kind`` is that
    of the maker, ``who`` its words, ``words`` the outcome, and ``good`` whether that was as wanted.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    stage: Annotated[int, Field(ge=1, le=9)]
    kind: MakerKind
    who: _Short
    of: dict[_Short, _Digest]
    words: _Short = ""
    good: bool = True
    time: Annotated[float, Field(ge=0, le=1e12, allow_inf_nan=False)] = 0.0


class _Notes(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)
    version: Literal[1]
    texts: Annotated[tuple[_Path, ...], Field(max_length=100)] = ()
    hardware: Annotated[tuple[_Path, ...], Field(max_length=100)] = ()
    require: _Path | Literal[""] = ""
    doubts: Annotated[tuple[_Doubt, ...], Field(max_length=MOST_DOUBTS)] = ()
    done: Annotated[tuple[StageNote, ...], Field(max_length=9)] = ()


@dataclass(frozen=True)
class DesignNotes:
    """The notes of a blueprint. ``texts``, ``hardware`` and ``require`` are files, absolute.
    ``doubts`` are what the last generation says otherwise than the stages before it."""

    texts: tuple[Path, ...] = ()
    hardware: tuple[Path, ...] = ()
    require: Path | None = None
    doubts: tuple[str, ...] = ()
    done: Mapping[int, StageNote] = field(default_factory=dict)


def notes_beside(file: str) -> Path:
    """Return where the notes of a blueprint's file stand."""
    return Path(f"{file}{SUFFIX}")


def read_notes(file: str) -> DesignNotes:
    """Return the notes of a blueprint's file; empty ones if there are none. ReadError for a file
    that holds no notes."""
    path = notes_beside(file)
    try:
        raw = read_ordinary(path, LARGEST).raw
    except FileNotFoundError:
        return NO_NOTES
    except (OSError, ValueError) as error:
        raise _refusal(path, getattr(error, "strerror", None) or str(error)) from None
    if len(raw) > LARGEST:
        raise _refusal(path, f"it is larger than {LARGEST >> 20} MB")
    try:
        read = _Notes.model_validate_json(raw)
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        where = ".".join(map(str, first["loc"])) or "the file"
        raise _refusal(path, f"{where}: {first['msg']}") from None

    def placed(one: str) -> Path:
        return Path(os.path.normpath(path.absolute().parent / one))

    return DesignNotes(
        tuple(map(placed, read.texts)),
        tuple(map(placed, read.hardware)),
        placed(read.require) if read.require else None,
        read.doubts,
        {one.stage: one for one in read.done},
    )


def write_notes(notes: DesignNotes, file: str) -> None:
    """Write the notes of a blueprint's file. Files are named from its folder. SaveError if that
    fails."""
    path = notes_beside(file).absolute()

    def named(one: Path) -> str:
        return Path(os.path.relpath(one, path.parent)).as_posix()

    values = _Notes(
        version=1,
        texts=tuple(map(named, notes.texts)),
        hardware=tuple(map(named, notes.hardware)),
        require=named(notes.require) if notes.require is not None else "",
        doubts=tuple(one[:1000] for one in notes.doubts[:MOST_DOUBTS]),
        done=tuple(notes.done[stage] for stage in sorted(notes.done)),
    )
    text = json.dumps(values.model_dump(mode="json"), ensure_ascii=False, indent=1)
    save_document(f"{text}\n", path)


def _refusal(path: Path, reason: str) -> ReadError:
    return ReadError(
        f"the notes of the design cycle cannot be read: {reason}",
        Place(str(path), 1, 1),
        "Move the file away; nothing but these notes is lost.",
    )


NO_NOTES = DesignNotes()
