"""Generated texts of the native form: any values, in any layout a person might write."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Iterator
from typing import Any

from smsl_studio.smsl.native_form.spellings import header_key, header_value
from smsl_studio.smsl.native_form.tokens import spelled

Json = Any


def plain(values: Json) -> Json:
    """The values as the native form holds them: no HEADER with nothing in it, HEADER first."""
    return {
        name: value if name.startswith("_") else _plain_branch(value)
        for name, value in values.items()
    }


def _plain_branch(value: Json) -> Json:
    rest = {key: inner for key, inner in value.items() if key != "HEADER"}
    return {"HEADER": value["HEADER"], **rest} if value.get("HEADER") else rest


class Writer:
    """Writes values in one of very many layouts, chosen by the seed."""

    def __init__(self, seed: int) -> None:
        self.chance = random.Random(seed)
        self.wild = self.chance.random()
        self.comma: Callable[[], str] = self.chance.choice(
            [lambda: ",", lambda: "", lambda: self.chance.choice(["", ",", ",,", " , ,"])]
        )
        self.unit = self.chance.choice(["    ", "  ", "\t"])

    def gap(self) -> str:
        """White space and comments between two tokens."""
        if self.chance.random() > self.wild * 0.4:
            return ""
        return self.chance.choice([" ", "\n", "  \t", " // x -> y ]\n", "//\n", "\n// {\n\n"])

    def gaps(self, *tokens: str) -> str:
        return "".join(token + self.gap() for token in tokens)

    def name(self, name: str) -> str:
        quoted = json.dumps(name, ensure_ascii=self.chance.random() < 0.2)
        return quoted if self.chance.random() < 0.1 else spelled(name)

    def end_of_line(self) -> str:
        return self.chance.choice(["", "", "", " // a note", "  "]) + "\n"

    def field(self, key: str, value: Json, before: str = "") -> str:
        space = self.chance.choice(["", " ", "  "])
        separators = self.chance.choice([(",", ":"), (", ", ": ")])
        text = json.dumps(value, ensure_ascii=False, separators=separators)
        return f"#{space}{before}{spelled(key)}{space}: {text}{self.end_of_line()}"

    def file(self, values: Json) -> str:
        bom = "\ufeff" if self.chance.random() < 0.2 else ""
        pieces = [bom, self.gap()]
        for key, value in values.items():
            pieces.append(self.gap())
            if key.startswith("_"):
                pieces.append(self.field(key, value))
            else:
                pieces += [self.branch(key, value), self.comma(), self.gap(), "\n"]
        text = "".join([*pieces, self.gap()])
        if self.chance.random() < 0.2:
            text = text.replace("\n", self.chance.choice(["\r\n", "\r"]))
        return text.rstrip("\n") if self.chance.random() < 0.2 else text

    def branch(self, name: str, value: Json) -> str:
        parts = [*self.members(name, value)]
        at = self.chance.choice([0, 0, 0, self.chance.randrange(len(parts) + 1)])
        name_line = f"#{self.chance.choice(['', ' '])}NAME: {self.name(name)}{self.end_of_line()}"
        parts.insert(at, name_line)
        first = self.chance.choice([" ", "\n", "", " // opened\n"])
        return "".join(["{", first, *(self.unit + part for part in parts), "}"])

    def members(self, branch: str, value: Json) -> Iterator[str]:
        for key, inner in value.get("HEADER", {}).items():
            if key.startswith("_"):
                yield self.field(key, inner, "HEADER.")
            else:
                text = header_value(branch, key, inner)
                yield f"# {header_key(key)}: {text}{self.end_of_line()}"
        for key, inner in value.items():
            if key == "HEADER":
                continue
            yield self.field(key, inner) if key.startswith("_") else self.state(key, inner)

    def state(self, name: str, value: Json) -> str:
        pieces = [self.gaps(self.name(name), ":"), " ["]
        start = self.chance.choice(["", " ", f"\n{self.unit * 2}"])
        for key, inner in value.items():
            if key.startswith("_"):
                pieces += [f"\n{self.unit * 2}", self.field(key, inner), self.unit]
                continue
            arrow = self.chance.choice([" -> ", "->"])
            edge = self.name(key) + self.gap() + arrow + self.gap() + self.name(inner)
            pieces += [start, edge, self.gap(), self.comma() or " "]
        return "".join([*pieces, self.gap(), "]", self.comma(), self.end_of_line()])


def native(values: Json, seed: int) -> str:
    """The values as a native text in one of very many layouts."""
    return Writer(seed).file(values)
