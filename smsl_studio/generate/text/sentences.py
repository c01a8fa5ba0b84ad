"""What a sentence of a procedure says: to do something, to wait, or what to do if."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from smsl_studio.generate.text import language_words as words

_SPLIT = re.compile(r"(?<=[.!?;])\s+(?=[\w\"“„(])")
_SHORTENED = re.compile(
    r"(\b(e\.g|i\.e|approx|ca|dr|prof|no|fig|min|sec|max|resp|vs|z\. ?B|d\. ?h|bzw|ggf|evtl|usw|nr)"
    r"|(?<!\d )\b[A-Za-z])\.$",
    re.IGNORECASE,
)
_SECONDS = {"m": 60.0, "h": 3600.0, "s": 1.0}
_AND = re.compile(r"\s*(?:,|\band\b|\bund\b)\s*(?:the\s+|der\s+|die\s+|das\s+)?", re.IGNORECASE)
_LEAD = re.compile(r"^(?:then|next|first|finally|after that|now|dann|danach|zuerst|zunächst"
                   r"|anschließend|schließlich|nun),?\s+", re.IGNORECASE)  # fmt: skip
_PLAIN_ROLE = "|".join(sorted(map(re.escape, (*words.ROLES, *words.ROBOTS)), key=len, reverse=True))
_SUBJECT = re.compile(
    rf"^(?:(?:the|a|an|one|der|die|das|ein|eine)\s+)?(?P<who>{_PLAIN_ROLE})\b"
    r"(?:\s+(?:must|should|shall|has to|will|muss|soll))?(?P<colon>\s*:)?\s+(?P<act>\S.*)$",
    re.IGNORECASE,
)
_BEHIND = re.compile(rf"\s*[(\[](?P<who>{_PLAIN_ROLE})[)\]]\s*(?=[.!]?$)", re.IGNORECASE)


@dataclass(frozen=True)
class TextSentence:
    """A sentence with its place in the text of its part."""

    text: str
    start: int
    end: int


@dataclass(frozen=True)
class TextCondition:
    """If ``when``, then ``act``."""

    when: str
    act: str


def sentences_of(text: str) -> Iterator[TextSentence]:
    """Yield the sentences of a text. A point after a number or a shortened word ends none."""
    start = 0
    for found in _SPLIT.finditer(text):
        before = text[start : found.start()]
        if _SHORTENED.search(before) and not before.endswith(("!", "?", ";")):
            continue
        yield TextSentence(before, start, found.start())
        start = found.end()
    if text[start:].strip():
        yield TextSentence(text[start:], start, len(text))


def condition_of(text: str) -> TextCondition | None:
    """Return what is to be done under which condition, or None."""
    found = words.IF_FIRST.match(text) or words.IF_LAST.match(text)
    if found is None:
        return None
    act = _LEAD.sub("", found["act"].strip())
    return TextCondition(found["when"].strip(" ,"), capital(act))


def open_condition(text: str) -> str:
    """Return the condition of ``If nobody breathes:``, which a list follows. Empty elsewhere."""
    found = words.IF_OPEN.match(text)
    return found["when"].strip(" ,") if found else ""


def awaited(text: str) -> str:
    """Return what is waited for: ``Wait until the tracker is warm.`` Empty if nothing is."""
    found = words.WAIT.match(text)
    if found is None or found["what"][:1].isdigit():
        return ""
    what = found["what"].strip()
    if found["once"] or found["sobald"]:
        return what.partition(",")[0] if "," in what else ""
    return what


def after_waiting(text: str) -> str:
    """Return what follows in ``Once the cement is ready, inject it.`` Empty elsewhere."""
    found = words.WAIT.match(text)
    if found is None or not (found["once"] or found["sobald"]):
        return ""
    return capital(_LEAD.sub("", found["what"].partition(",")[2].strip()))


def is_pause(text: str) -> bool:
    """Return whether a sentence only says how long to wait."""
    return bool(words.PAUSE.match(text.rstrip(".! ")))


def until(text: str) -> tuple[str, str]:
    """Split ``Press until the bleeding stops`` into what is done and what must be seen."""
    found = words.UNTIL.match(text)
    if found is None or words.TIME.fullmatch(found["what"].strip()):
        return text, ""
    return found["act"].strip(), found["what"].strip()


def otherwise(text: str) -> str:
    """Return what follows ``otherwise``, empty elsewhere."""
    found = words.ELSE.match(text)
    return capital(found["act"].strip()) if found else ""


def who_and_what(text: str) -> tuple[str, str]:
    """Return the role that a sentence names as the one who acts, and the sentence without it where
    it stands apart (``Nurse: fix the leg``, ``Fix the leg (nurse)``)."""
    text = _LEAD.sub("", text)
    if found := _BEHIND.search(text):
        rest = (text[: found.start()] + text[found.end() :]).strip()
        return (role(found["who"]), rest) if any(map(str.isalnum, rest)) else ("", text)
    if found := _SUBJECT.match(text):
        return role(found["who"]), capital(found["act"]) if found["colon"] else text
    return "", text


def role(name: str) -> str:
    """Return the role of a name, ``robot`` for the system. An unknown name stays."""
    plain = re.sub(r"^(the|a|an|der|die|das)\s+", "", name.strip().lower())
    return "robot" if plain in words.ROBOTS else words.ROLES.get(plain, name.strip())


def confirmers(text: str) -> tuple[str, ...]:
    """Return the roles that must agree before a step begins."""
    found = words.CONFIRMED.search(text)
    if found is None:
        return ()
    who = re.sub(r"^(the|der|die|das)\s+", "", found["who"], flags=re.IGNORECASE)
    names = [name for name in _AND.split(who) if name]
    known = [name.lower() for name in names if name.lower() in words.ROLES]
    return tuple(words.ROLES[name] for name in known) if len(known) == len(names) else ()


def within(text: str) -> float | None:
    """Return the longest time (s) that a sentence permits, or None."""
    found = words.WITHIN.search(text)
    return seconds(text[found.end() :]) if found else None


def seconds(text: str) -> float | None:
    """Return the first time in a text in seconds, or None."""
    found = words.TIME.search(text)
    if found is None:
        return None
    unit = found["unit"].lower()
    factor = 0.001 if unit == "ms" else 3600.0 if unit.startswith("st") else _SECONDS[unit[0]]
    many = float(found["many"].replace(",", ".")) * factor
    return many if 0 < many <= 1e6 else None


def risk(text: str) -> tuple[str, str]:
    """Return the risk that a sentence declares, and the sentence without it."""
    found = words.RISK.search(text)
    if found is None:
        return "", text
    said = (found["en"] or found["of"] or found["de"]).lower()
    rest = " ".join((text[: found.start()] + text[found.end() :]).split())
    return words.RISK_WORDS.get(said.partition(" ")[0], said), rest or text


def capital(text: str) -> str:
    """Return a text that begins with a capital letter."""
    return text[:1].upper() + text[1:]
