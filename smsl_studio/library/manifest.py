"""``plugin.toml``: what a plugin folder says about itself."""

from __future__ import annotations

from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.errors import Place, PluginError
from smsl_studio.library.toml_text import read_toml


class Manifest(BaseModel):
    """``name`` is how functions are called (``name.function``); the rest is for people."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = Field(pattern=r"^[a-z][a-z0-9_]*$", max_length=60)
    version: str = "0"
    description: str = ""
    license: str = ""
    authors: tuple[str, ...] = ()


def read_manifest(path: Path) -> Manifest:
    """The manifest in a file; PluginError with the place of what does not fit."""
    text, values = read_toml(path)
    try:
        return Manifest.model_validate(values)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        key = ".".join(str(part) for part in fault["loc"])
        line = text.line_of(str(fault["loc"][0])) if fault["loc"] else 1
        raise PluginError(f"{key}: {fault['msg']}", Place(str(path), line, 1)) from None
