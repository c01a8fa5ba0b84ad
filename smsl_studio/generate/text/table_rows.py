"""The rows of a table of steps. The heads of the columns say what a cell is."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.generate.text import sentences
from smsl_studio.generate.text.expert_text import Citation
from smsl_studio.generate.text.language_words import AGAIN, GO_ON
from smsl_studio.generate.text.outline import TextPart
from smsl_studio.generate.text.steps import Remedy, Source, TextStep, mark_of, risk_of

HEADS = {
    "act": ("action", "activity", "task", "what", "what to do", "do", "description", "handlung",
            "tätigkeit", "aufgabe", "was", "maßnahme", "arbeitsschritt"),
    "number": ("no", "no.", "nr", "nr.", "#", "number", "nummer"),
    "step": ("step", "schritt"),
    "who": ("who", "role", "person", "by", "actor", "wer", "rolle", "durch"),
    "until": ("until", "check", "done when", "result", "sign", "bis", "kontrolle", "fertig wenn",
              "prüfung", "ergebnis"),
    "time": ("time", "duration", "within", "time limit", "dauer", "zeit", "frist"),
    "when": ("if", "problem", "failure", "if not", "wenn", "fehler", "störung"),
    "then": ("then", "if it fails", "on failure", "recovery", "remedy", "dann", "bei fehler",
             "abhilfe"),
    "risk": ("risk", "risiko"),
}  # fmt: skip


def row_step(row: TextPart) -> Iterator[TextStep | Remedy]:
    """Yield the step of a row, and what is done if it fails."""
    cells = _cells(row)
    act = cells.get("act", "")
    if not any(char.isalpha() for char in act):
        return
    danger, act = sentences.risk(act)
    who, act = sentences.who_and_what(act.rstrip(". "))
    who = sentences.role(cells["who"]) if cells.get("who", "").strip(" -–") else who
    told = cells.get("risk", "").strip().lower()
    mark = cells.get("number", "").strip(". )")
    yield TextStep(
        do=sentences.capital(act)[:200],
        mark=mark_of(mark),
        who=who[:200],
        until=cells.get("until", "").strip(" -–")[:200],
        within=sentences.seconds(cells.get("time", "")),
        risk=risk_of(danger or told),
        sources=(_source(row, cells.get("act", "")),),
    )
    remedy = cells.get("then", "").strip(" -–.")
    if remedy:
        condition = sentences.condition_of(remedy)
        when = condition.when if condition else cells.get("when", "").strip(" -–.")
        do = condition.act if condition else remedy
        failed = when if when else f"{act}: failed"
        yield Remedy(
            when=sentences.capital(failed)[:200],
            do=sentences.capital(do)[:200],
            back="on" if GO_ON.search(do) and not AGAIN.search(do) else "again",
            sources=(_source(row, cells["then"]),),
        )


def _cells(row: TextPart) -> dict[str, str]:
    """Return the cells of a row by what they are. Without a head for the action it is the longest
    text."""
    found: dict[str, str] = {}
    for head, cell in row.cells.items():
        kind = next((kind for kind, heads in HEADS.items() if head.strip() in heads), "")
        if kind:
            found.setdefault(kind, cell)
    step = found.pop("step", "")
    if any(char.isalpha() for char in step):
        found.setdefault("act", step)
    elif step:
        found.setdefault("number", step)
    if "act" not in found:
        left = [cell for cell in row.cells.values() if cell not in found.values()]
        found["act"] = max(left, key=len, default="")
    return found


def _source(row: TextPart, words: str) -> Source:
    whole: Citation = row.cite()
    at = row.text.find(words)
    return Source.of(row.cite(at, at + len(words)) if words and at >= 0 else whole)
