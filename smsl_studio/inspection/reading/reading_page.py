"""A reading as one HTML file. It loads nothing and runs nothing: no script, image, font or link.

Its policy (CSP) forbids them, whatever text a blueprint contains. The light and the dark look come
from the reader's system.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from smsl_studio.inspection.reading.sections import (
    NOTICE,
    BlueprintReading,
    ReadingLine,
    ReadingSection,
)
from smsl_studio.legible import markup
from smsl_studio.picture.colours import DARK, LIGHT, Colours
from smsl_studio.picture.words import FAMILY, MONO_FAMILY


@dataclass(frozen=True)
class Illustration:
    """A picture of a part of the blueprint as SVG, or the reason why there is none."""

    title: str
    svg: str = ""
    reason: str = ""


def reading_page(
    reading: BlueprintReading,
    date: str,
    pictures: Sequence[Illustration] = (),
    approval: Sequence[str] = (),
) -> str:
    """Return the page. ``date`` is the day that it bears, such as ``2026-11-26``, or empty.

    ``approval`` has sentences that say whether people have signed the blueprint, the badge first.
    """
    return "\n".join(_page(reading, date, pictures, approval)) + "\n"


def _page(
    reading: BlueprintReading, date: str, pictures: Sequence[Illustration], approval: Sequence[str]
) -> Iterator[str]:
    title = markup(reading.title)
    read_on, made_on = (f", read on {markup(date)}", f" on {markup(date)}") if date else ("", "")
    yield "<!DOCTYPE html>"
    yield '<html lang="en"><head><meta charset="utf-8">'
    yield '<meta http-equiv="Content-Security-Policy" '
    yield "content=\"default-src 'none'; style-src 'unsafe-inline'\">"
    yield '<meta name="viewport" content="width=device-width, initial-scale=1">'
    yield f"<title>{title}</title><style>{_style()}</style></head><body><main>"
    yield f"<header><h1>{title}</h1><p class=lead>{markup(reading.purpose)}</p>"
    yield f'<p class="about">{markup(reading.file)}{read_on}. {NOTICE}.</p>'
    if approval:
        badge, *reasons = map(markup, approval)
        yield f'<p class="about"><span class="flag">{badge}</span> {" ".join(reasons)}</p>'
    yield f'<p class="about">Digest <code>{markup(reading.digest)}</code></p></header>'
    yield from _contents(reading, bool(pictures))
    for section in reading.sections:
        yield from _section(section)
    yield from _pictures(pictures)
    yield f"<footer>Made by SMSL Studio from {markup(reading.file)}{made_on}. "
    yield f"{NOTICE}.</footer></main></body></html>"


def _contents(reading: BlueprintReading, pictures: bool) -> Iterator[str]:
    yield '<nav aria-label="Contents"><h2>Contents</h2><ol>'
    for section in reading.sections:
        open_points = sum(line.open_point for line in section.lines)
        yield f'<li><a href="#{section.key}">{section.heading}</a>'
        if open_points:
            yield f' <span class="flag">{open_points} open</span>'
        yield "</li>"
    yield '<li><a href="#pictures">Pictures</a></li>' if pictures else ""
    yield "</ol></nav>"


def _section(section: ReadingSection) -> Iterator[str]:
    yield f'<section id="{section.key}"><h2>{section.heading}</h2>'
    if section.lead:
        yield f"<p>{markup(section.lead)}</p>"
    for line in section.lines:
        yield from _line(line, 3)
    yield "</section>"


def _line(line: ReadingLine, level: int) -> Iterator[str]:
    kind = "line open" if line.open_point else "line"
    yield f'<article class="{kind}">'
    if line.mark:
        yield f'<span class="mark">{markup(line.mark)}</span>'
    yield "<div>"
    flag = ' <span class="flag">open</span>' if line.open_point else ""
    yield f"<h{level}>{markup(line.heading)}{flag}</h{level}>"
    if line.text:
        yield f"<p>{markup(' '.join(line.text))}</p>"
    if line.who:
        yield f'<p class="who"><b>Who</b> {markup(line.who)}</p>'
    if line.check:
        yield f'<p class="who"><b>Check</b> {markup(line.check)}</p>'
    for source in line.sources:
        yield f'<p class="who"><b>Source</b> {markup(source)}</p>'
    for one in line.inner:
        yield from _line(one, min(level + 1, 6))
    yield "</div></article>"


def _pictures(pictures: Sequence[Illustration]) -> Iterator[str]:
    if not pictures:
        return
    yield '<section id="pictures"><h2>Pictures</h2>'
    for one in pictures:
        yield f"<figure><figcaption>{markup(one.title)}</figcaption>"
        yield one.svg or f"<p>{markup(one.reason)}</p>"
        yield "</figure>"
    yield "</section>"


def _style() -> str:
    return (
        f":root{{color-scheme:light dark;{_variables(LIGHT)}}}"
        f"@media (prefers-color-scheme:dark){{:root{{{_variables(DARK)}}}}}"
        f"body{{margin:0;background:var(--win);color:var(--tx);font:16px/1.55 {FAMILY}}}"
        "main{max-width:52rem;margin:0 auto;padding:2rem 1.5rem}"
        "h1{font-size:1.75rem;line-height:1.2;margin:0}h2{font-size:1.25rem;margin:2.5rem 0 .5rem}"
        "h3,h4,h5,h6{font-size:1.05rem;margin:0}p{margin:.35rem 0}"
        "h1,h2,h3,h4,h5,h6,p,li{overflow-wrap:anywhere}"
        ".lead{font-size:1.1rem;color:var(--tx2)}.about,footer{color:var(--tx3);font-size:.9rem}"
        "nav ol{columns:2;padding-left:1.25rem}nav h2{font-size:1rem}a{color:var(--acc)}"
        ".line{display:flex;gap:1rem;padding:.9rem 0;border-top:1px solid var(--line)}"
        ".line>div{flex:1;min-width:0}.line .line{padding:.6rem 0}"
        ".mark{flex:none;box-sizing:border-box;min-width:2.2rem;height:2.2rem;padding:0 .4rem;"
        "border:1px solid var(--nl);border-radius:1.1rem;text-align:center;line-height:2.1rem;"
        "font-weight:600;font-variant-numeric:tabular-nums}"
        ".who{color:var(--tx2)}.who b{color:var(--tx3);font-weight:600;margin-right:.35rem}"
        ".flag{background:var(--risks);color:var(--risk);border-radius:.3rem;padding:.05rem .4rem;"
        "font-size:.8rem;font-weight:600;white-space:nowrap}"
        f"code{{font-family:{MONO_FAMILY};font-size:.85em;overflow-wrap:anywhere}}"
        "figure{margin:1rem 0;padding:1rem;background:#fff;color:#161B22;border-radius:.5rem;"
        "overflow-x:auto}figcaption{font-weight:600;margin-bottom:.5rem}"
        "figure svg{max-width:100%;height:auto}footer{margin-top:3rem}"
        "@media print{body{background:#fff;font-size:11pt}main{max-width:none;padding:0}"
        ".line,figure{break-inside:avoid}h2{break-after:avoid}nav{break-after:page}}"
    )


def _variables(colours: Colours) -> str:
    used = ("win", "line", "nl", "tx", "tx2", "tx3", "acc", "risk", "risks")
    return ";".join(f"--{name}:{colours[name]}" for name in used)
