"""The merge of lines, for files that git hands over and that are no blueprints."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.output import note
from smsl_studio.errors import ReadError
from smsl_studio.front.inputs import read_bytes
from smsl_studio.smsl.files import read_content


def by_lines(files: Sequence[str], name: str) -> int | None:
    """Merge base, ours and theirs into ours line by line, if one of them is no blueprint.

    Return the exit status, 1 if there are conflicts. None if all are blueprints, or empty.
    """
    base, ours, theirs = files
    if all(_is_blueprint(file, name) for file in files):
        return None
    labels = [word for label in ("ours", "base", "theirs") for word in ("-L", label)]
    done = subprocess.run(
        ["git", "merge-file", *labels, "--", ours, base, theirs], check=False,
        stdin=subprocess.DEVNULL, capture_output=True,
    )  # fmt: skip
    note(f"{name}: merged line by line, because it is no blueprint")
    return min(done.returncode, 1)


def _is_blueprint(file: str, name: str) -> bool:
    raw = read_content(file).raw
    if not raw.strip():
        return True
    try:
        return _leads_to_states(read_bytes(raw, name))
    except ReadError:
        return False


def _leads_to_states(blueprint: Blueprint) -> bool:
    """Whether it has a header, or an operation that leads to a state of its SB. Other files of maps
    and texts can be read as blueprints too."""
    if not len(blueprint):
        return True
    return any(
        branch.header.present or any(edge.target in branch.table for edge in branch.edges())
        for branch in blueprint
    )
