"""``plugin.toml``: what a plugin folder says about itself."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.errors import Place, PluginError
from smsl_studio.library.toml_text import read_toml

MANIFEST = "plugin.toml"
LARGEST = 100_000
"""Bytes of the longest manifest that is read."""


class Manifest(BaseModel):
    """``name`` is how functions are called (``name.function``); the rest is for people.

    ``worlds``, ``operations``, ``sensors`` and ``faults`` say what the code registers, for who is
    asked whether it may run. What is said must be all there is of that kind.
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

    @property
    def registers(self) -> Mapping[str, tuple[str, ...]]:
        """What the code registers, by kind; empty where nothing is said about a kind."""
        kinds = ("worlds", "operations", "sensors", "faults")
        return {kind: getattr(self, kind) for kind in kinds}


def read_manifest(path: Path) -> Manifest:
    """The manifest in a file; PluginError with the place of what does not fit."""
    text, values = read_toml(path, LARGEST)
    try:
        return Manifest.model_validate(values)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        key = ".".join(str(part) for part in fault["loc"])
        line = text.line_of(str(fault["loc"][0])) if fault["loc"] else 1
        raise PluginError(f"{key}: {fault['msg']}", Place(str(path), line, 1)) from None
