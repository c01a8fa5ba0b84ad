"""The manifest ``plugin.toml``: a plugin folder's own description."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.errors import Place, PluginError
from smsl_studio.library.toml_text import read_toml

MANIFEST = "plugin.toml"
LARGEST = 400_000
"""The largest size of a manifest, in bytes."""


class GeneratedFunction(BaseModel):
    """A function that nobody has written by hand: its ``SB/Operation``, its file beside the
    manifest, and its name in there."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    operation: str = Field(min_length=3, max_length=1000)
    file: str = Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*\.py$", max_length=200)
    function: str = Field(pattern=r"^[a-z][a-z0-9_]*$", max_length=400)


class Manifest(BaseModel):
    """The content of ``plugin.toml``.

    ``name`` is the first part of the functions' names (``name.function``); the rest is for people.
    ``worlds``, ``operations``, ``sensors``, ``faults`` and ``supervisors`` list the entries that
    the code registers, so that a user can decide whether it may run. A list must be complete, or be
    left out. A plugin of ``generated`` functions has these and no other code: it has no
    ``plugin.py``.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = Field(pattern=r"^[a-z][a-z0-9_]*$", max_length=60)
    version: str = Field(default="0", max_length=100)
    description: str = Field(default="", max_length=2000)
    license: str = ""
    authors: tuple[str, ...] = ()
    worlds: tuple[str, ...] = ()
    operations: tuple[str, ...] = ()
    sensors: tuple[str, ...] = ()
    faults: tuple[str, ...] = ()
    supervisors: tuple[str, ...] = ()
    generated: tuple[GeneratedFunction, ...] = Field(default=(), max_length=1000)

    @property
    def registers(self) -> Mapping[str, tuple[str, ...]]:
        """The entries that the code registers, by kind. A kind that is left out is empty."""
        kinds = ("worlds", "operations", "sensors", "faults", "supervisors")
        return {kind: getattr(self, kind) for kind in kinds}


def read_manifest(path: Path) -> Manifest:
    """Read a manifest. PluginError, with its place, if the file does not fit."""
    text, values = read_toml(path, LARGEST)
    try:
        return Manifest.model_validate(values)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        key = ".".join(str(part) for part in fault["loc"])
        line = text.line_of(str(fault["loc"][0])) if fault["loc"] else 1
        raise PluginError(f"{key}: {fault['msg']}", Place(str(path), line, 1)) from None
