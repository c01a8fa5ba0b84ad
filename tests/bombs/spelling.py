"""Writes values as text in each written form, without the writers that are under test."""

from __future__ import annotations

import json
from typing import Any

Json = Any
FORMS = ("json", "smsl", "yaml")


def spelled(values: dict[str, Json], form: str) -> str:
    """The values of a blueprint as a text."""
    if form == "json":
        return _one_a_line(values)
    if form == "yaml":
        return "".join(_yaml_branch(name, value) for name, value in values.items())
    return "".join(_native_branch(name, value) for name, value in values.items())


def one(value: Json) -> str:
    """A value in JSON, on one line."""
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def _one_a_line(values: dict[str, Json]) -> str:
    """Each member of an SB on a line of its own."""
    branches = []
    for name, value in values.items():
        if isinstance(value, dict) and not name.startswith("_"):
            inner = ",\n".join(f"{one(key)}:{one(item)}" for key, item in value.items())
            branches.append(f"{one(name)}:{{{inner}}}")
        else:
            branches.append(f"{one(name)}:{one(value)}")
    return "{" + ",\n".join(branches) + "}\n"


def _yaml_branch(name: str, value: Json) -> str:
    """An SB in block style, what stands below its states in flow style."""
    if not isinstance(value, dict) or name.startswith("_") or not value:
        return f"{one(name)}: {one(value)}\n"
    return f"{one(name)}:\n" + "".join(f" {one(key)}: {one(item)}\n" for key, item in value.items())


def _native_branch(name: str, value: Json) -> str:
    if name.startswith("_"):
        return f"# {_key(name)}: {one(value)}\n"
    lines = [f"{{\n# NAME: {one(name)}"]
    for key, item in value.items():
        if key == "HEADER":
            lines += (f"# {_key(word)}: {one(said)}" for word, said in item.items())
        elif key.startswith("_"):
            lines.append(f"# {_key(key)}: {one(item)}")
        else:
            edges = ",".join(f"{one(edge)}->{one(target)}" for edge, target in item.items())
            lines.append(f"{one(key)}:[{edges}]")
    return "\n".join(lines) + "\n}\n"


def _key(name: str) -> str:
    return name if name.replace("_", "").isalnum() and name.isascii() else one(name)
