"""Writes XML for other programs, indented, with names of any characters."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from xml.sax.saxutils import escape, quoteattr

from smsl_studio.errors import Place, ReadError
from smsl_studio.exchange.xml_tree import XmlElement

HEAD = '<?xml version="1.0" encoding="UTF-8"?>'
SMSL = "urn:smsl-studio:blueprint:1"
"""The namespace of what Studio writes beside the elements of a form."""

_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""The characters that no XML can hold, not even as a reference."""


def tag(name: str, attributes: Mapping[str, str], close: str = "") -> str:
    """Return the start tag of an element. ``close`` is ``/`` for one without content."""
    told = "".join(f" {key}={quoteattr(value)}" for key, value in attributes.items())
    return f"<{name}{told}{close}>"


def text_element(name: str, text: str, attributes: Mapping[str, str] | None = None) -> str:
    """Return an element with a text. Characters that XML cannot hold become ``?``."""
    return f"{tag(name, attributes or {})}{escape(shown(text))}</{name}>"


def shown(text: str) -> str:
    """Return a text without the characters that XML cannot hold."""
    return _FORBIDDEN.sub("?", text)


def exact(key: str, text: str) -> Iterator[tuple[str, str]]:
    """Yield the attribute that holds a text exactly: as it is, or as a JSON text under
    ``KEY-json``."""
    if _FORBIDDEN.search(text):
        yield f"{key}-json", json.dumps(text)
    else:
        yield key, text


def exact_of(element: XmlElement, key: str, file: str) -> str:
    """Return the text that ``exact`` has put into the attributes of an element, empty if there
    is none."""
    escaped = element.get(f"{key}-json")
    if not escaped:
        return element.get(key)
    try:
        found = json.loads(escaped)
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, str) or any("\ud800" <= char <= "\udfff" for char in found):
        words, advice = f"{key}-json is no JSON text", "Remove this attribute."
        raise ReadError(words, Place(file, *element.place), advice)
    return found
