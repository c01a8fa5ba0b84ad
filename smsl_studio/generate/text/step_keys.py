"""The lines below a step of ``pm.md`` that say who, until when and what if: ``- who: nurse``."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from smsl_studio.generate.text import sentences
from smsl_studio.generate.text.steps import Remedy, Source, TextStep, mark_of, risk_of

KEYED = re.compile(
    r"^(?P<key>who|until|confirm|takes|within|risk|wait|if|source|wer|bis|wenn|quelle)\s*:\s*(?P<said>.+)$",
    re.IGNORECASE,
)
_GERMAN = {"wer": "who", "bis": "until", "wenn": "if", "quelle": "source"}
_IF = re.compile(r"^(?P<when>.+?)\s*->\s*(?P<do>.+?)(?:\s*\[(?P<back>on|again|start|[\d.]+)\])?$")
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


def _remedies(text: str) -> list[Remedy]:
    found = _IF.match(text)
    if found is None:
        return []
    back = found["back"] or "again"
    back = back if back in ("on", "again", "start") else mark_of(back) or "again"
    return [Remedy(when=found["when"][:200], do=found["do"][:200], back=back)]


def _cite(said: dict[str, Any], text: str) -> None:
    """Take a source: it belongs to the step, or to the condition in the line before it."""
    found = _SOURCE.match(text)
    if found is None:
        return
    page = int(found["page"] or 0)
    line, words = int(found["line"]), found["words"][:300]
    if line < 1:
        return
    source = Source(file=found["file"][:300], line=line, words=words, page=page)
    if said.get("remedies"):
        last = said["remedies"][-1]
        said["remedies"][-1] = last.model_copy(update={"sources": (*last.sources, source)})
    else:
        said["sources"] = (*said.get("sources", ()), source)
