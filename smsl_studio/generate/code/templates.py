"""Templates of generated code (Jinja2). They stand in ``resources/code/``, one file each."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from smsl_studio.legible import one_line
from smsl_studio.shipped import resources_dir

if TYPE_CHECKING:
    from jinja2 import Environment

MOST = 72
"""The largest number of characters of a name in a comment."""


def rendered(target: str, name: str, **values: Any) -> str:
    """Return the text of a template of a target, such as ``python``."""
    return _environment(target).get_template(f"{name}.jinja").render(**values)


def remark(text: str) -> str:
    """Return a text from outside for a comment or a docstring: one line of plain ASCII, cut, that
    ends neither.
    """
    shown = one_line(text).encode("ascii", "backslashreplace").decode("ascii")
    plain = shown.replace("\\", "/").replace('"', "'").replace("*/", "* /").replace("`", "'")
    return plain if len(plain) <= MOST else f"{plain[: MOST - 3]}..."


@cache
def _environment(target: str) -> Environment:
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    folder = resources_dir() / "code" / target / "templates"
    return Environment(
        loader=FileSystemLoader(folder),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        autoescape=False,
    )
