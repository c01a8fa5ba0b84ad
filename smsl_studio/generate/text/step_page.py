"""``pm.md``: the steps as a page that people read and change. The reader reads it again."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.generate.text.expert_text import Citation
from smsl_studio.generate.text.steps import Remedy, Source, TextProcedure, TextStep

Json = Any


def step_page(procedure: TextProcedure, origin: Mapping[str, Json]) -> str:
    """Return the page. ``origin`` says how it was made."""
    lines = ["---", f"_origin: {json.dumps(dict(origin), ensure_ascii=False)}", "---", ""]
    lines += [f"# {procedure.title}", "", *_listed(procedure.steps, "")]
    if procedure.cautions:
        lines += ["", "## Cautions", ""]
        for caution in procedure.cautions:
            lines += [f"- {caution.words}", *(_source(one, "  ") for one in caution.sources)]
    return "\n".join(lines) + "\n"


def _listed(steps: tuple[TextStep, ...], indent: str) -> Iterator[str]:
    for number, step in enumerate(steps, 1):
        yield f"{indent}{number}. {step.do}"
        inner = indent + "   "
        for key, said in _said(step):
            yield f"{inner}- {key}: {said}"
        yield from (_source(one, inner) for one in step.sources)
        for remedy in step.remedies:
            yield f"{inner}- if: {_remedy(remedy)}"
            yield from (_source(one, inner) for one in remedy.sources)
        yield from _listed(step.steps, inner)


def _said(step: TextStep) -> Iterator[tuple[str, str]]:
    if step.who:
        yield "who", step.who
    if step.confirm:
        yield "confirm", ", ".join(step.confirm)
    if step.until:
        yield "until", step.until
    if step.wait:
        yield "wait", "yes"
    for key, seconds in (("takes", step.takes), ("within", step.within)):
        if seconds is not None:
            yield key, f"{seconds:g} s"
    if step.risk:
        yield "risk", step.risk


def _remedy(remedy: Remedy) -> str:
    by = f", by {remedy.who}" if remedy.who else ""
    return f"{remedy.when} -> {remedy.do} [{remedy.back}{by}]"


def _source(source: Source, indent: str) -> str:
    one: Citation = source.citation
    return f"{indent}- source: {one}"
