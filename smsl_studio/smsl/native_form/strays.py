"""Reports text in a place where it is not possible, with a repair, and skips it."""

from __future__ import annotations

import re
from collections.abc import Container

from smsl_studio.errors import TextFix
from smsl_studio.smsl.native_form import tokens
from smsl_studio.smsl.native_form.faults import Faults
from smsl_studio.smsl.native_form.lines import HashLine

_STATE = re.compile(rf"{tokens.NAME}{tokens.GAP}:")
_RUN = re.compile(r"[^\r\n{}\[\]#]*+")
_REST_OF_LINE = re.compile(r"[^\r\n}]*+")
_SIGNS = re.compile(r"(?>(?:[>()/:]++|->)+)")
_CLOSERS = {"}": "{", "]": "["}
_ADVICE = {
    "state": "A State Branch holds # lines and states, such as State0: [Operation -> State1].",
    "outside": "A file holds State Branches, { # NAME: SB1 ... }, and # _KEY: lines.",
}
_NAME_LINE = re.compile(r"#\s*NAME\b([^\r\n]*+)")
_HEADER_KEY = re.compile(r"#\s*(?:NAME|INITIAL|ACTIVATING|NUM_FACTS|NUM_STATES|SUB_SBS|_\w+)\b")


def begins_state(text: str, at: int) -> bool:
    """Return whether a name and a colon are at ``at``."""
    return _STATE.match(text, at) is not None


def outside(text: str, at: int, faults: Faults) -> int:
    """Report something that is not possible between State Branches. Return the offset after it."""
    return _stray(text, at, faults, _ADVICE["outside"])


def inside(text: str, at: int, faults: Faults) -> int:
    """Report something that is not possible in a State Branch or state. Return the offset after
    it.
    """
    return _stray(text, at, faults, _ADVICE["state"])


def no_state(text: str, at: int, behind: int, name: str, faults: Faults) -> int:
    """Report a name in a State Branch without colon and bracket. Return the offset to read on
    from.
    """
    arrow = tokens.edge.match(text, at)
    if arrow:
        return _edges_outside(text, at, faults)
    rest = _REST_OF_LINE.match(text, behind)
    if rest and rest[0].strip(" \t,") and not rest[0].strip(" \t,").startswith("//"):
        return inside(text, at, faults)
    sentence = f"{name!r} is no state: a colon and [ ] are missing"
    fix = TextFix("Write : [ ]", behind, behind, ": [ ]")
    faults.add(at, behind, sentence, _ADVICE["state"], fix)
    return behind


def _edges_outside(text: str, at: int, faults: Faults) -> int:
    """Report operations outside a state. Return the offset after them and after a ] that
    follows.
    """
    end, behind = at, at
    while edge := tokens.edge.match(text, behind):
        end = edge.end()
        behind = tokens.skip_separator(text, end)
    advice = "Operations stand in the [ ] of their state: State0: [Operation -> State1]."
    faults.add(at, end, "these operations stand in no state", advice)
    return behind + 1 if text[behind : behind + 1] == "]" else end


def broken_line(text: str, at: int, faults: Faults) -> int:
    """Report a ``#`` that begins no valid line. Return the offset after the line."""
    line = tokens.rest_of_line.match(text, at)
    end = line.end() if line else at + 1
    key = tokens.name.match(text, end - len(text[at + 1 : end].lstrip()))
    if key and _HEADER_KEY.match(text, at):
        fix = TextFix("Put : behind it", key.end(), key.end(), ":")
        sentence = f": is missing behind {key[0]}"
        faults.add(at, key.end(), sentence, "A header line is # KEY: value.", fix)
    else:
        fix = TextFix("Make it a comment", at, at + 1, "//")
        sentence = "this is no header line"
        advice = "A header line is # KEY: value; a comment begins with //."
        faults.add(at, len(text[:end].rstrip()), sentence, advice, fix)
    return end


def meant_name(text: str, at: int) -> str | None:
    """Return the probable name in a broken NAME line, None if it is another line."""
    match = _NAME_LINE.match(text, at)
    return match[1].strip(' \t":=') or None if match else None


def second_name(text: str, at: int, line: HashLine, faults: Faults) -> None:
    """Report a second NAME in one State Branch. Probably the next State Branch begins here."""
    fix = TextFix("Begin a State Branch", at, at, "}\n{\n")
    sentence = "this State Branch has a NAME already"
    advice = "Close it with }, and open the next one with {, or take one NAME away."
    faults.add(at, line.key_end, sentence, advice, fix)


def not_closed(text: str, start: int, at: int, name: str | None, faults: Faults) -> None:
    """Report a State Branch without a closing brace. It ends at the next one or at the end of the
    file.
    """
    end = _behind_last(text, start, at)
    where = f"the State Branch {name!r}" if name else "the State Branch"
    fix = TextFix("Close it with }", end, end, "\n}")
    sentence = f"{where} is not closed: }} is missing"
    faults.add(end, end + 1, sentence, "Put } behind its last state.", fix)


def state_not_closed(text: str, opened: int, last: int, at: int, name: str, faults: Faults) -> None:
    """Report a state without a closing bracket. It ends before something that is in no state."""
    end = max(last, opened + 1)
    fix = TextFix("Close it with ]", end, end, "]")
    sentence = f"the state {name!r} is not closed: ] is missing"
    faults.add(end, end + 1, sentence, "Put ] behind its last operation.", fix)


def no_name(text: str, start: int, known: Container[str], faults: Faults | None) -> str:
    """Return a new name for a State Branch without one, and report it if there are ``faults``."""
    name = free_name(known)
    if faults is not None:
        behind = tokens.rest_of_line.match(text, start + 1)
        more = "\n" if behind and behind[0].strip() else ""
        fix = TextFix("Give it a NAME", start + 1, start + 1, f"\n    # NAME: {name}{more}")
        sentence = "this State Branch has no NAME"
        faults.add(start, start + 1, sentence, f"Write # NAME: {name} behind the {{.", fix)
    return name


def free_name(known: Container[str]) -> str:
    """Return the first of SB1, SB2 ... that is not known."""
    number = 1
    while f"SB{number}" in known:
        number += 1
    return f"SB{number}"


def _stray(text: str, at: int, faults: Faults, advice: str) -> int:
    mark = text[at]
    if mark in _CLOSERS:
        fix = TextFix("Take it away", at, at + 1, "")
        sentence = f"nothing is open that this {mark} could close"
        advice = f"Take it away, or put {_CLOSERS[mark]} where it opens."
        faults.add(at, at + 1, sentence, advice, fix)
        return at + 1
    run = _SIGNS.match(text, at)
    behind = run and tokens.skip_separator(text, run.end())
    if not behind or not (begins_state(text, behind) or tokens.edge.match(text, behind)):
        run = _RUN.match(text, at)
    words = run[0].rstrip() if run else ""
    end = at + max(1, len(words))
    shown = words if len(words) < 30 else f"{words[:29]}…"
    faults.add(at, end, f"this cannot stand here: {shown or mark}", advice)
    return end


def _behind_last(text: str, start: int, at: int) -> int:
    """Return the offset after the last token before ``at``, its comma and the comment on its
    line.
    """
    end = start + 1
    for match in _TOKEN.finditer(text, start + 1, at):
        if not match[0].startswith("//"):
            end = match.end()
    line = _REST.match(text, end, at)
    return line.end() if line else end


_TOKEN = re.compile(rf'//[^\r\n]*+|#[^\r\n]*+|{tokens.NAME}|->|[{{}}\[\]:()>/]|"(?:[^\r\n]*\S)?')
"""A quote that is not closed extends to the end of its line. So no other token is searched
there.
"""
_REST = re.compile(r"[^\S\r\n]*+,?(?:[^\S\r\n]*+//[^\r\n]*+)?")
