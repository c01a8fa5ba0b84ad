"""What a window can begin with: an empty blueprint, or a sample."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.blueprint.writing import new_blueprint
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.forms import SUFFIXES

UNTITLED = "untitled.json"


def samples() -> tuple[Path, ...]:
    """The samples that are shipped, in every form."""
    found = (path for path in samples_dir().iterdir() if path.suffix in SUFFIXES)
    return tuple(sorted(found))


def empty_blueprint() -> Blueprint:
    """The blueprint that New shows: one SB without states."""
    blank = new_blueprint(UNTITLED)
    return editing.add_branch(blank, fresh_branch_name(blank))
