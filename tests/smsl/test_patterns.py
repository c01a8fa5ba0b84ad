"""Patterns of the written forms that every Python reads alike.

Before Python 3.11.5 a possessive repeat of what may begin in two ways keeps a part of what it tried
in vain (python/cpython#106052). Debian 12 has Python 3.11.2.
"""

from __future__ import annotations

import importlib
import pkgutil
import re
from collections.abc import Iterator
from re import _constants as words
from re import _parser as parser
from typing import Any

import pytest

import smsl_studio.smsl

CHOICES = (words.BRANCH, words.MAX_REPEAT, words.MIN_REPEAT)


def patterns() -> dict[str, re.Pattern[str]]:
    """The compiled patterns of all modules of the room, by module and name."""
    found: dict[str, re.Pattern[str]] = {}
    room = smsl_studio.smsl
    for module in pkgutil.walk_packages(room.__path__, f"{room.__name__}."):
        values = vars(importlib.import_module(module.name)).items()
        found |= {f"{module.name}.{n}": v for n, v in values if isinstance(v, re.Pattern)}
    return found


def parts(tree: Any) -> Iterator[tuple[Any, Any]]:
    """Every operation of a parsed pattern, with its arguments."""
    for operation, given in tree:
        yield operation, given
        for inner in given if isinstance(given, (tuple, list)) else (given,):
            for one in inner if isinstance(inner, list) else (inner,):
                if isinstance(one, parser.SubPattern):
                    yield from parts(one)


def is_misread(pattern: str) -> bool:
    """Whether a part that is repeated possessively may begin or go on in two ways."""
    return any(
        operation is words.POSSESSIVE_REPEAT and any(word in CHOICES for word, _ in parts(given[2]))
        for operation, given in parts(parser.parse(pattern))
    )


@pytest.mark.parametrize("pattern", ["(?:a|bc)++", "x(?:a(?:b+|c))*+", "(?:a?b)++"])
def test_it_finds_them(pattern: str) -> None:
    assert is_misread(pattern)


@pytest.mark.parametrize("pattern", ["(?>(?:a|bc)+)", "[ab]++", "(?:a[^b]*+)*+", "(?:a|b)+"])
def test_others_are_let_alone(pattern: str) -> None:
    assert not is_misread(pattern)


def test_no_pattern_is_misread() -> None:
    found = patterns()
    assert len(found) > 30
    assert [name for name, one in found.items() if is_misread(one.pattern)] == []
