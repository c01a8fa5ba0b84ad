"""The table of the bombs: their names, and the written forms in which each is made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from types import ModuleType

from tests.bombs import shapes, texts
from tests.bombs.spelling import FORMS, spelled

_YAML_ONLY = (
    *("laughs", "merge_keys", "many_anchors", "anchored_states", "tags", "foreign_tags"),
    *("dashes", "block_lists", "stairs", "flow_one_key_maps", "documents", "folded"),
    *("question_marks",),
)


@dataclass(frozen=True)
class Bomb:
    """Too much of something: ``make(form, n)`` is a text with ``n`` of it."""

    name: str
    make: Callable[[str, int], str]
    forms: tuple[str, ...] = FORMS
    readable: bool = True

    def sized(self, form: str, size: int) -> str:
        """The text of about so many bytes."""
        n = _count(self, form, size)
        return self.make(form, n)


@cache
def _count(bomb: Bomb, form: str, size: int) -> int:
    """How many pieces make a text of that size."""
    few, more = (len(_encoded(bomb.make(form, n))) for n in (200, 400))
    n = max(2, round(200 + (size - few) * 200 / max(more - few, 1)))
    if few < size < 1 << 26:  # a piece grows with the number of digits that its number has
        n = max(2, round(n * size / len(_encoded(bomb.make(form, n)))))
    return n


def _encoded(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


def _functions(module: ModuleType) -> list[str]:
    return [
        name
        for name, made in vars(module).items()
        if callable(made) and not name.startswith("_") and made.__module__ == module.__name__
    ]


def _shape(name: str) -> Bomb:
    make = getattr(shapes, name)
    forms = ("json", "yaml") if name in ("wrong_sbs", "wrong_states") else FORMS
    return Bomb(name, lambda form, n: spelled(make(n), form), forms)


def _text(name: str) -> Bomb:
    forms = ("smsl",) if name.startswith("native_") else FORMS
    return Bomb(name, getattr(texts, name), ("yaml",) if name in _YAML_ONLY else forms, False)


BOMBS = tuple(map(_shape, _functions(shapes))) + tuple(map(_text, _functions(texts)))
BY_NAME = {bomb.name: bomb for bomb in BOMBS}
