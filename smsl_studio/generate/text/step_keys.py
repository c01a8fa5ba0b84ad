"""The lines below a step of ``pm.md`` that say who, until when and what if: ``- who: nurse``."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from smsl_studio.errors import did_you_mean
from smsl_studio.generate.text import sentences
from smsl_studio.generate.text.steps import Remedy, Source, TextStep, mark_of, risk_of

KEYED = re.compile(
    r"^(?P<key>who|until|confirm|takes|within|risk|wait|if|source|wer|bis|wenn|quelle)\s*:\s*(?P<said>.+)$",
    re.IGNORECASE,
)
_KEYS = ("who", "until", "confirm", "takes", "within", "risk", "wait", "if", "source")
_LIKE_KEY = re.compile(r"^(?P<key>[a-z]{2,12})\s*:\s*\S")
_BACK = re.compile(r"->.*\[(?P<back>[^\]]*)\]\s*$")
_GERMAN = {"wer": "who", "bis": "until", "wenn": "if", "quelle": "source"}
_IF = re.compile(
    r"^(?P<when>.+?)\s*->\s*(?P<do>.+?)"
    r"(?:\s*\[(?P<back>on|again|start|[\d.]+)(?:,\s*by\s+(?P<who>[^\]]+))?\])?$"
)
_SOURCE = re.compile(
    r"^(?P<file>[^,]+?),\s*(?:page\s+(?P<page>\d{1,5}),\s*)?line\s+(?P<line>\d{1,6})\s*:\s*[“\"](?P<words>.+)[”\"]$"
)


def keyed_step(step: TextStep, lines: Sequence[str]) -> TextStep:
    """Return a step with what the lines below it say. A line that does not read says nothing."""
    said: dict[str, Any] = {}
    for line in lines:
        found = KEYED.match(line)
        if found is None:
            continue
        key, text = found["key"].lower(), found["said"].strip()
        key = _GERMAN.get(key, key)
        if key == "if":
            said.setdefault("remedies", list(step.remedies)).extend(_remedies(text))
        elif key == "source":
            _cite(said, text)
        elif key == "confirm":
            said["confirm"] = tuple(one.strip() for one in text.split(",") if one.strip())[:10]
        elif key in ("takes", "within"):
            said[key] = sentences.seconds(text)
        elif key == "wait":
            said[key] = text.lower() in ("yes", "true", "ja")
        elif key == "risk":
            said[key] = risk_of(text)
        else:
            said[key] = sentences.role(text)[:200] if key == "who" else text[:200]
    said = {key: tuple(one) if isinstance(one, list) else one for key, one in said.items()}
    return step.model_copy(update=said)


def source_of(text: str) -> Source | None:
    """Return what a line says behind ``source:``. None if it does not read."""
    found = _SOURCE.match(text.strip())
    if found is None or int(found["line"]) < 1:
        return None
    file, words, page = found["file"][:300], found["words"][:300], int(found["page"] or 0)
    return Source(file=file, line=int(found["line"]), words=words, page=page)


def unread(line: str) -> str:
    """Return why a line that begins with a key, or with nearly one, says nothing. Empty for any
    other line."""
    text = re.sub(r"^\s*[-*+]\s+", "", line).strip()
    found = KEYED.match(text)
    if found is None:
        like = _LIKE_KEY.match(text) if line[:1].isspace() and text != line.strip() else None
        return did_you_mean(like["key"], _KEYS) if like else ""
    key, text = found["key"].lower(), found["said"].strip()
    key = _GERMAN.get(key, key)
    if key == "source" and source_of(text) is None:
        return 'write it as: source: protocol.md, line 12: "the quoted words"'
    if key == "if" and not _remedies(text):
        return "write it as: if: what is wrong -> what is done then [again]"
    if key == "if" and (back := _BACK.search(text)) and _IF.match(text)["back"] is None:  # type: ignore[index]
        return f"write [on], [again], [start] or the number of a step, not [{back['back']}]"
    if key in ("takes", "within") and sentences.seconds(text) is None:
        return "write a time, such as 20 s"
    if key == "risk" and not risk_of(text):
        return "write low, medium or high"
    return ""


def _remedies(text: str) -> list[Remedy]:
    found = _IF.match(text)
    if found is None:
        return []
    back = found["back"] or "again"
    back = back if back in ("on", "again", "start") else mark_of(back) or "again"
    who = sentences.role(found["who"] or "")[:200]
    return [Remedy(when=found["when"][:200], do=found["do"][:200], back=back, who=who)]


def _cite(said: dict[str, Any], text: str) -> None:
    """Take a source: it belongs to the step, or to the condition in the line before it."""
    source = source_of(text)
    if source is None:
        return
    if said.get("remedies"):
        last = said["remedies"][-1]
        said["remedies"][-1] = last.model_copy(update={"sources": (*last.sources, source)})
    else:
        said["sources"] = (*said.get("sources", ()), source)
