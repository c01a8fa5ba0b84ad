"""The user's decisions about plugins (allowed or forbidden): a small JSON file in the user's
folder.

The file decides which code runs. So it is believed only if no other user could have written it, and
if it has exactly the declared form.
"""

from __future__ import annotations

import json
import os
import secrets
import stat
from collections.abc import Mapping
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.errors import Place, PluginError, SaveError
from smsl_studio.home import user_folder
from smsl_studio.library.ownership import exposure_of, exposure_on_the_way
from smsl_studio.smsl.disk import held, settle, write_new

FILE = "plugin-decisions.json"
LARGEST = 4_000_000
"""The largest size of a file of decisions, in bytes."""

PATIENCE = 2.0
"""The wall time (s) to wait for another program that writes the file at the same time."""

_REMEDY = "Repair or remove it; every plugin of yours is then asked about anew."


class PluginDecision(BaseModel):
    """The decision about the plugin at ``location``.

    ``digest`` is the digest of the files that were allowed. It is empty if the files do not matter,
    as for a forbidden plugin.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    location: str = Field(min_length=1, max_length=10_000)
    name: str = Field(max_length=1000)
    decision: Literal["allowed", "forbidden"]
    digest: str = Field(default="", pattern=r"^([0-9a-f]{64})?$")


class _DecisionsFile(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    version: Literal[1]
    plugins: list[PluginDecision]


def decisions_file() -> Path:
    """Return the path of the file with the decisions. The file need not exist."""
    return user_folder() / FILE


def read_decisions() -> Mapping[str, PluginDecision]:
    """Read the decisions by location. There are none if there is no file. PluginError if the file
    is not believed."""
    file = decisions_file()
    try:
        found = file.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return {}
    except OSError as error:
        raise _not_believed(file, f"it cannot be read: {error.strerror or error}") from None
    if not stat.S_ISREG(found.st_mode):
        raise _not_believed(file, "it is no ordinary file")
    exposed = exposure_on_the_way(file) or exposure_of(file, found)
    if exposed is not None:
        what = "it" if exposed.path == file else str(exposed.path)
        raise _not_believed(file, f"{what} {exposed.words}", exposed.advice)
    return _decisions_in(file)


def decide(decision: PluginDecision, *, forget: bool = False) -> None:
    """Write a decision, which replaces an earlier decision about the same location.

    ``forget`` only removes the earlier decision. SaveError if the file cannot be written.
    PluginError if the present file is not believed.
    """
    file = decisions_file()
    try:
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with held([file.parent], PATIENCE) as alone:
            if not alone:
                raise SaveError(
                    f"{file} is being written by another program",
                    advice="Try again in a moment.",
                )
            known = dict(read_decisions())
            known.pop(decision.location, None)
            if not forget:
                known[decision.location] = decision
            _write(file, known)
    except OSError as error:
        raise SaveError(f"{file} cannot be written: {error.strerror or error}") from None


def _decisions_in(file: Path) -> Mapping[str, PluginDecision]:
    try:
        with file.open("rb") as stream:
            raw = stream.read(LARGEST + 1)
    except OSError as error:
        raise _not_believed(file, f"it cannot be read: {error.strerror or error}") from None
    if len(raw) > LARGEST:
        raise _not_believed(file, f"it is longer than {LARGEST} bytes")
    try:
        written = _DecisionsFile.model_validate(json.loads(raw))
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        where = ".".join(str(part) for part in fault["loc"])
        raise _not_believed(file, f"{where}: {fault['msg']}" if where else fault["msg"]) from None
    except (ValueError, RecursionError) as error:
        raise _not_believed(file, f"it is no JSON: {error}") from None
    decisions = {one.location: one for one in written.plugins}
    if len(decisions) < len(written.plugins):
        raise _not_believed(file, "it decides twice about one plugin")
    return decisions


def _write(file: Path, decisions: Mapping[str, PluginDecision]) -> None:
    """Replace the file as a whole: a failure leaves the old file."""
    plugins = [one.model_dump() for one in sorted(decisions.values(), key=lambda d: d.location)]
    text = json.dumps({"version": 1, "plugins": plugins}, indent=4)
    part = file.with_name(f".{file.name}.{secrets.token_hex(8)}.part")
    try:
        write_new(part, f"{text}\n".encode("ascii"), 0o600)
        os.replace(part, file)  # noqa: PTH105
    finally:
        part.unlink(missing_ok=True)
    settle([file.parent])


def _not_believed(file: Path, words: str, advice: str = _REMEDY) -> PluginError:
    return PluginError(
        f"the decisions about plugins are not believed: {words}", Place(str(file), 1, 1), advice
    )
