"""A reading as a PDF with a title, an outline and tags, written by typst (PDF/A-2a, PDF/UA-1).

The reading goes to typst as data. So no name in a blueprint is read as markup.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from smsl_studio.inspection.reading.reading_page import Illustration
from smsl_studio.inspection.reading.sections import NOTICE, BlueprintReading, ReadingLine
from smsl_studio.legible import whole_text
from smsl_studio.picture.document import as_document

Json = Any
_SOURCE = """
#let told = json(bytes(sys.inputs.reading))
#set document(title: told.title, author: "SMSL Studio", date: datetime(
  year: told.day.at(0), month: told.day.at(1), day: told.day.at(2)))
#set text(lang: "en", size: 10.5pt, font: ("Inter", "DejaVu Sans", "Libertinus Serif"))
#set par(leading: 0.65em, spacing: 0.7em)
#set page(paper: "a4", margin: (x: 22mm, top: 24mm, bottom: 24mm), numbering: "1",
  header: text(size: 8pt, fill: rgb("#5F6979"))[#told.file #h(1fr) #told.notice],
  footer: context text(size: 8pt, fill: rgb("#5F6979"))[
    #told.date, digest #raw(told.digest.slice(0, 16)) #h(1fr)
    #counter(page).display("1 of 1", both: true)])
#show heading.where(level: 1): it => block(above: 0pt, below: 10pt, text(size: 20pt, it.body))
#show heading.where(level: 2): it => block(above: 22pt, below: 8pt, text(size: 14pt, it.body))
#show heading.where(level: 3): it => block(above: 0pt, below: 5pt, text(size: 11pt, it.body))
#let entry(one, depth) = {
  let mark = if one.mark == "" { [] } else { text(weight: "bold", one.mark) }
  block(above: 14pt, below: 6pt, inset: (left: depth * 16pt), width: 100%, breakable: true, {
    if depth == 0 {
      heading(level: 3, [#mark#if one.mark != "" [ #h(4pt) ]#one.heading#if one.open [ (open)]])
    } else {
      text(weight: "bold", [#mark#if one.mark != "" [ #h(4pt) ]#one.heading#if one.open [ (open)]])
    }
    if one.text != "" { par(one.text) }
    if one.who != "" { par([*Who:* #one.who]) }
    if one.check != "" { par([*Check:* #one.check]) }
    for source in one.sources { par([*Source:* #source]) }
  })
  for inner in one.inner { entry(inner, depth + 1) }
}
#heading(level: 1, told.title)
#par(told.purpose)
#par(text(size: 9pt, fill: rgb("#465060"))[#told.file, read on #told.date. #told.notice.])
#if told.badge != "" {
  par(text(size: 9pt, fill: rgb("#465060"))[*#told.badge.* #told.approval])
}
#par(text(size: 9pt, fill: rgb("#465060"))[Digest: #told.digest])
#block(above: 18pt, below: 6pt, text(size: 12pt, weight: "bold")[Contents])
#outline(title: none, depth: 2)
#for section in told.sections {
  heading(level: 2, section.heading)
  if section.lead != "" { par(section.lead) }
  for one in section.lines { entry(one, 0) }
}
#if told.pictures.len() > 0 {
  heading(level: 2, [Pictures])
  for one in told.pictures {
    heading(level: 3, one.title)
    if one.svg == "" { par(one.reason) } else {
      layout(room => {
        let drawn = (..size) => image(bytes(one.svg), format: "svg", alt: one.title, ..size)
        let high = measure(block(width: room.width, drawn(width: 100%))).height
        // A picture that is higher than a page would be cut at both ends.
        let most = 0.9 * room.height
        if high > most { align(center, drawn(height: most)) } else { drawn(width: 100%) }
      })
    }
  }
}
"""


def reading_sheet(
    reading: BlueprintReading,
    date: str,
    pictures: Sequence[Illustration] = (),
    approval: Sequence[str] = (),
) -> bytes:
    """Return the PDF. ``date`` is the day on which it was made. ``approval`` has sentences that say
    whether people have signed the blueprint. ConvertError if it cannot be written.
    """
    told = {
        "title": _text(reading.title),
        "purpose": _text(reading.purpose),
        "file": _text(reading.file),
        "digest": reading.digest,
        "badge": _text(approval[0]) if approval else "",
        "approval": _text(" ".join(approval[1:])),
        "date": date,
        "day": [int(part) for part in date.split("-")],
        "notice": NOTICE,
        "sections": [
            {
                "heading": section.heading,
                "lead": _text(section.lead),
                "lines": [_entry(line) for line in section.lines],
            }
            for section in reading.sections
        ],
        "pictures": [
            {"title": _text(one.title), "svg": one.svg, "reason": _text(one.reason)}
            for one in pictures
        ],
    }
    return as_document(_SOURCE, {"reading": json.dumps(told)})


def _entry(line: ReadingLine) -> dict[str, Json]:
    return {
        "mark": _text(line.mark),
        "heading": _text(line.heading),
        "text": _text(" ".join(line.text)),
        "who": _text(line.who),
        "check": _text(line.check),
        "sources": [_text(source) for source in line.sources],
        "open": line.open_point,
        "inner": [_entry(one) for one in line.inner],
    }


def _text(text: str) -> str:
    """Return a text for typst: hidden characters as escapes, and only valid Unicode."""
    return whole_text(text).encode("utf-8", "replace").decode("utf-8")
