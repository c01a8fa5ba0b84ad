"""An account of a run as one HTML file: what was believed, sensed, done and decided, and by whom.

It is made from the log alone, and equal logs give equal bytes. The page loads nothing and runs
nothing: it has no script, image, font or link. Its policy (CSP) forbids them, whatever text a log
contains.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from typing import Any

from smsl_studio.legible import markup
from smsl_studio.picture.account_people import worded
from smsl_studio.picture.account_words import AccountLine, told, vanished
from smsl_studio.picture.colours import DARK, LIGHT, Colours
from smsl_studio.picture.words import FAMILY, MONO_FAMILY
from smsl_studio.runlog.causes import Causes
from smsl_studio.runlog.changes import moment_after
from smsl_studio.runlog.command_word import CommandWords
from smsl_studio.runlog.decisions import deciders
from smsl_studio.runlog.events import Event, RoutePlanned
from smsl_studio.runlog.grammar.log_reader import LoggedRun
from smsl_studio.runlog.moment import RunMoment
from smsl_studio.runlog.names import HeaderNames

Json = Any
DEEP = 2
"""The largest depth of maps in a value of the header that is shown. A header may contain
anything.
"""
MOST = 100_000
"""The largest number of events that are listed. Browsers do not open a longer page."""

_OUTCOMES = {
    "goal_reached": "The goal was reached",
    "no_route": "Nothing permitted led to the goal",
    "held": "The run held, and nobody was there to decide",
    "refused": "The run was refused",
    "stopped": "The run was stopped",
    "failed": "The run failed",
}
_SIGNER = ("person", "role", "verdict", "time")
_GROUNDS = (
    ("keys", "Whose keys counted"),
    ("met", "Conditions met"),
    ("policy", "Trust policy (SHA-256)"),
    ("record", "Record (SHA-256)"),
    ("register", "Register (SHA-256)"),
)
_NO_END = "The log ends before the run did"
_HEADER = (
    ("file", "Blueprint"),
    ("wall_time", "Begun (UTC)"),
    ("world", "World"),
    ("seed", "Seed"),
    ("host", "Host of library code"),
    ("start", "Start asked for"),
    ("goals", "Goals asked for"),
    ("avoid", "Operations to avoid"),
    ("on_mismatch", "On a mismatch"),
    ("levels", "Levels set before the run"),
    ("mqtt", "Sensors elsewhere"),
    ("script", "Script"),
    ("supervisor", "Supervised by"),
    ("by_hand", "Run by hand"),
    ("badge", "Approval badge"),
    ("node", "Computer"),
)


def account(run: LoggedRun, commands: CommandWords) -> str:
    """Return the page of a run. ``commands`` are the commands that the log may contain."""
    return "\n".join(_page(run, commands)) + "\n"


def _page(run: LoggedRun, commands: CommandWords) -> Iterator[str]:
    file = str(run.header.get("file", "")).replace("\\", "/").rpartition("/")[2]
    title = f"Account of a run of {file}" if file else "Account of a run"
    yield "<!DOCTYPE html>"
    yield '<html lang="en"><head><meta charset="utf-8">'
    yield '<meta http-equiv="Content-Security-Policy" '
    yield "content=\"default-src 'none'; style-src 'unsafe-inline'\">"
    yield '<meta name="viewport" content="width=device-width, initial-scale=1">'
    yield f"<title>{markup(title)}</title>"
    yield f"<style>{_style()}</style></head><body><main>"
    yield f"<h1>{markup(title)}</h1>"
    end = moment_after(run.events)
    yield from _outcome(run, end)
    yield from _pairs("What was asked for", _header(run.header))
    yield from _pairs("Digests (SHA-256)", _named(run.header.get("digests")), code=True)
    yield from _pairs("Versions", _named(run.header.get("versions")))
    names = HeaderNames.of_header(run.header.get("names"))
    yield from _routes(run.events, names)
    yield from _decisions(run)
    yield from _events(run.events, end, names, commands)
    yield "<footer>Made by SMSL Studio from the run's log. Not a medical device.</footer>"
    yield "</main></body></html>"


def _outcome(run: LoggedRun, moment: RunMoment) -> Iterator[str]:
    end = moment.finished
    good = end is not None and end.reason == "goal_reached"
    yield f'<section class="outcome {"good" if good else "bad"}">'
    if end is None:
        last = run.events[-1].t if run.events else 0.0
        yield f"<p><strong>{_NO_END}.</strong> Its last event is at {last:.3f} s.</p>"
    else:
        what = _OUTCOMES.get(end.reason, end.reason)
        done = f"{end.operations} operation{'' if end.operations == 1 else 's'}"
        yield f"<p><strong>{markup(what)}.</strong> {markup(end.sentence)}</p>"
        yield f"<p>{done} committed in {end.t:.3f} simulated seconds.</p>"
        where = (f"{branch}/{state}" for branch, state in end.configuration.items())
        yield f"<p>Believed at the end: {_list(where)}.</p>" if end.configuration else ""
    yield "</section>"
    if run.doubt is not None:
        line = run.doubt.place.line
        yield f'<p class="seal bad"><strong>Not verified</strong>, line {line}: '
        yield f"{markup(run.doubt.sentence)}.</p>"
    elif run.head is not None:
        yield '<p class="seal"><strong>Verified</strong>: the chain holds over the whole log '
        yield f"({run.head.count} events), and its head <code>{markup(run.head.hash)}</code>. "
        if run.head.signed:
            yield "It carries a signature of its head, which <code>replay --verify</code> checks."
        else:
            yield "It is not signed: nothing was changed since, unless all of it was written anew."
        yield "</p>"


def _routes(events: tuple[Event, ...], names: HeaderNames) -> Iterator[str]:
    routes = [one for one in events if isinstance(one, RoutePlanned)]
    if not routes:
        return
    yield "<h2>Routes</h2>"
    left = MOST
    for one in routes:
        shown = one.operations[:left]
        left = max(0, left - len(shown) - 1)
        if not left:
            break
        goal = markup(names.address(one.goal))
        yield f"<h3>At {one.t:.3f} s, to {goal}, cost {one.cost:g}</h3><ol>"
        yield from (f"<li>{markup(names.address(step))}</li>" for step in shown)
        yield "</ol>"
    if not left:
        yield "<p>Further routes are left out here; the log has them.</p>"


def _decisions(run: LoggedRun) -> Iterator[str]:
    """Yield the table of who decided what. Nothing if nobody decided anything."""
    supervisor = run.header.get("supervisor")
    found = deciders(run.events, supervisor if isinstance(supervisor, str) else "")
    if not found:
        return
    yield "<h2>Who decided</h2><table><thead><tr><th>Who</th><th>Decisions</th>"
    yield "<th>After a question or a hold</th><th>Against an agent</th></tr></thead><tbody>"
    for one in found[:MOST]:
        who = f"{one.name}, automatic" if one.automatic else one.name
        against = "" if one.automatic else str(one.against)
        cells = "".join(f"<td>{markup(text)}</td>" for text in (one.decided, one.waited, against))
        yield f"<tr><td>{markup(who)}</td>{cells}</tr>"
    yield "</tbody></table>" + vanished(len(found) - MOST, "name")


def _events(
    events: tuple[Event, ...], end: RunMoment, names: HeaderNames, commands: CommandWords
) -> Iterator[str]:
    yield "<h2>What happened</h2>"
    yield "<table><thead><tr><th>Seconds</th><th>Kind</th><th>What</th><th>By</th></tr></thead>"
    yield "<tbody>"
    causes = Causes(commands, end.asked)
    for event in islice(events, MOST):
        cause = causes.of(event)
        one = worded(event, end.asked, names)
        yield _row(event.t, told(one, commands, end.world, cause, names))
    yield "</tbody></table>" + vanished(len(events) - MOST, "event")


def _row(t: float, one: AccountLine) -> str:
    cells = (
        f"<td>{t:.3f}</td><td>{one.kind}</td><td>{markup(one.what)}</td><td>{markup(one.by)}</td>"
    )
    return f'<tr class="{one.kind}{" bad" if one.bad else ""}">{cells}</tr>'


def _header(header: Mapping[str, Json]) -> Iterator[tuple[str, str]]:
    for key, words in _HEADER:
        if key in header:
            yield words, _said(header[key])
    if "policy" in header:
        yield from _approval(header["policy"])


def _approval(value: Json) -> Iterator[tuple[str, str]]:
    """Yield who approved the blueprint. The value comes from a log, so it may have any type."""
    if not isinstance(value, dict):
        yield "Approval", "Uninspected: this run asked for no approval"
        return
    yield "Approval", _said(value.get("verdict"))
    signers = value.get("signers")
    for one in signers if isinstance(signers, list) else ():
        if isinstance(one, dict):
            who, role, verdict, time = (_said(one.get(k)) for k in _SIGNER)
            yield "Signed by", f"{who} ({role}): {verdict}, {time}"
    for key, words in _GROUNDS:
        if value.get(key):
            yield words, _said(value[key])


def _named(values: Json) -> Iterator[tuple[str, str]]:
    if isinstance(values, dict):
        for name, value in values.items():
            if isinstance(value, dict):
                yield from ((f"{name} {key}", _said(inner)) for key, inner in value.items())
            else:
                yield name, _said(value)


def _pairs(title: str, pairs: Iterator[tuple[str, str]], code: bool = False) -> Iterator[str]:
    rows = list(pairs)
    if not rows:
        return
    yield f"<h2>{title}</h2><dl>"
    for name, value in rows:
        shown = f"<code>{markup(value)}</code>" if code else markup(value)
        yield f"<dt>{markup(name)}</dt><dd>{shown}</dd>"
    yield "</dl>"


def _said(value: Json, deep: int = DEEP) -> str:
    """Return a value of the header in one line. The value may be anything."""
    if value is None or value in ([], {}, ""):
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return ", ".join(_said(one) for one in value[:MOST] if isinstance(one, str | int))
    if isinstance(value, dict) and deep:
        pairs = ((name, _said(one, deep - 1)) for name, one in islice(value.items(), MOST))
        return "; ".join(f"{name}: {words}" for name, words in pairs)
    return str(value) if isinstance(value, str | int | float) else "not understood"


def _list(parts: Iterator[str]) -> str:
    return ", ".join(map(markup, parts))


def _style() -> str:
    return (
        f":root{{color-scheme:light dark;{_variables(LIGHT)}}}"
        f"@media (prefers-color-scheme:dark){{:root{{{_variables(DARK)}}}}}"
        f"body{{margin:0;background:var(--win);color:var(--tx);font:14px/1.5 {FAMILY}}}"
        "main{max-width:72rem;margin:0 auto;padding:2rem 1.5rem}"
        "h1{font-size:1.5rem}h2{font-size:1.1rem;margin-top:2rem}h3{font-size:1rem}"
        ".outcome,.seal{padding:.75rem 1rem;border-left:4px solid var(--ok);background:var(--surf)}"
        ".outcome.bad,.seal.bad{border-color:var(--bad)}"
        "dl{display:grid;grid-template-columns:max-content 1fr;gap:.25rem 1.5rem}"
        "dt{color:var(--tx3)}dd{margin:0}dd,td,li{overflow-wrap:anywhere}"
        f"code{{font-family:{MONO_FAMILY};font-size:.9em}}"
        "table{border-collapse:collapse;width:100%}"
        "th,td{text-align:left;vertical-align:top;padding:.3rem .75rem .3rem 0;"
        "border-bottom:1px solid var(--line)}"
        "th{color:var(--tx3);font-weight:600}td:first-child{white-space:nowrap;"
        "font-variant-numeric:tabular-nums}tr.bad td:nth-child(3){color:var(--bad)}"
        "footer{margin-top:2rem;color:var(--tx3)}"
        "@media print{body{background:#fff}main{max-width:none;padding:0}tr{break-inside:avoid}}"
    )


def _variables(colours: Colours) -> str:
    used = ("win", "surf", "line", "tx", "tx3", "ok", "bad")
    return ";".join(f"--{name}:{colours[name]}" for name in used)
