"""Finds the Python file of a behavior that a manifest of FlexBE names."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.errors import Place, ReadError
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.xml_tree import xml_tree

_UP = 4
"""How many folders above the manifest are looked into."""
_LONGEST = 200
"""The largest number of characters of a module's name: no name of a file is longer."""


def behavior_file(text: str, file: str, findings: ExchangeFindings) -> str:
    """Return the file of the behavior of a manifest. ReadError if it is none, or is not there.

    FlexBE puts it beside or above the manifest, in the folders of its package, with or without
    ``src``. Its name is made of identifiers alone, so it leads nowhere else.
    """
    root = xml_tree(text, file)
    executable = next(root.named("executable"), None)
    if root.name != "behavior" or executable is None:
        words = "it is no manifest of FlexBE: it has no <behavior> with an <executable>"
        raise ReadError(words, Place(file, *root.place), "Name the Python file of the behavior.")
    named = executable.get("package_path")
    parts = named.split(".")
    place = Place(file, *executable.place)
    if len(named) > _LONGEST or not all(part.isidentifier() for part in parts):
        words = f"the package_path {named[:200]!r} is no name of a module"
        raise ReadError(words, place, "Name the Python file of the behavior.")
    for one in root.named("params"):
        for param in one.named("param"):
            words = "A parameter of the behavior is not carried over."
            findings.add("param", param.get("name")[:200], words, param.place)
    inside = Path(*parts).with_suffix(".py")
    above = Path(file).parent
    for folder in [above, *above.resolve().parents][: _UP + 1]:
        packages = (folder, folder / "src", folder / parts[0] / "src")
        tried = (
            *(one / inside for one in packages),
            folder / "behaviors" / parts[0] / "src" / inside,
        )
        for path in (*tried, folder / inside.name):
            if path.is_file():
                return str(path)
    words = f"the behavior {named} is not there"
    raise ReadError(words, place, "Name the Python file of the behavior.")
