"""What became of generated functions in simulations: a small JSON file in the user's folder.

A function counts in a world once it has passed its sweep there, for the edges that were swept. The
file decides which code is offered, so it is believed only if no other user could have written it.
"""

from __future__ import annotations

import json
import os
import secrets
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.errors import Place, PluginError, SaveError
from smsl_studio.home import user_folder
from smsl_studio.library.ownership import exposure_of, exposure_on_the_way
from smsl_studio.smsl.disk import held, settle, write_new
from smsl_studio.smsl.inputs import read_ordinary

FILE = "function-trials.json"
LARGEST = 16_000_000
"""The largest size of the file, in bytes."""
MOST = 5_000
"""So many trials are kept, the newest ones."""
PATIENCE = 2.0
_Text = Annotated[str, Field(max_length=2_000)]
Key = tuple[str, str]


class FunctionTrial(BaseModel):
    """A sweep of one function in one world.

    ``function`` is its digest (see ``generated_functions``). ``edges`` are pairs of source and
    target. ``sentence`` says why it did not pass.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    function: str = Field(pattern=r"^[0-9a-f]{64}$")
    operation: _Text
    world: _Text
    passed: bool
    edges: list[tuple[_Text, _Text]]
    sentence: _Text = ""

    @property
    def key(self) -> Key:
        """The function and the world."""
        return self.function, self.world


class _TrialsFile(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    version: int
    trials: list[FunctionTrial]


def trials_file() -> Path:
    """Return the path of the file. It need not exist."""
    return user_folder() / FILE


def read_trials() -> Mapping[Key, FunctionTrial]:
    """Read the trials by function and world. There are none if there is no file. PluginError if the
    file is not believed."""
    file = trials_file()
    try:
        found = file.lstat()
        exposed = exposure_on_the_way(file) or exposure_of(file, found)
        if exposed is not None:
            raise _not_believed(file, f"{exposed.path} {exposed.words}", exposed.advice)
        raw = read_ordinary(file, LARGEST).raw
    except (FileNotFoundError, NotADirectoryError):
        return {}
    except OSError as error:
        raise _not_believed(file, f"it cannot be read: {error.strerror or error}") from None
    if len(raw) > LARGEST:
        raise _not_believed(file, f"it is longer than {LARGEST:,} bytes")
    try:
        written = _TrialsFile.model_validate_json(raw)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        raise _not_believed(file, str(fault["msg"])) from None
    if written.version != 1:
        raise _not_believed(file, "it is of another version")
    return {one.key: one for one in written.trials}


def keep_trials(trials: Iterable[FunctionTrial]) -> None:
    """Keep trials, in the place of earlier ones of the same functions and worlds. SaveError if the
    file cannot be written."""
    file = trials_file()
    try:
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with held([file.parent], PATIENCE) as alone:
            if not alone:
                words = f"{file} is being written by another program"
                raise SaveError(words, advice="Try again in a moment.")
            known = dict(read_trials())
            for one in trials:
                known.pop(one.key, None)
                known[one.key] = one
            _write(file, list(known.values())[-MOST:])
    except OSError as error:
        raise SaveError(f"{file} cannot be written: {error.strerror or error}") from None


def _write(file: Path, trials: Sequence[FunctionTrial]) -> None:
    """Replace the file as a whole: a failure leaves the old file."""
    told = {"version": 1, "trials": [one.model_dump(mode="json") for one in trials]}
    part = file.with_name(f".{file.name}.{secrets.token_hex(8)}.part")
    try:
        write_new(part, (json.dumps(told, indent=1) + "\n").encode("ascii"), 0o600)
        os.replace(part, file)  # noqa: PTH105
    finally:
        part.unlink(missing_ok=True)
    settle([file.parent])


def _not_believed(file: Path, words: str, advice: str = "") -> PluginError:
    return PluginError(
        f"the trials of generated functions are not believed: {words}",
        Place(str(file), 1, 1),
        advice or "Remove it, and sweep the functions again.",
    )
