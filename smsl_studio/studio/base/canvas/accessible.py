"""Words about states and operations, for tooltips and for assistive tools."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.guards import needs_words
from smsl_studio.studio.base.canvas.stage import Stage
from smsl_studio.studio.base.paint.guard_sign import WORDS
from smsl_studio.studio.base.words import counted

FINDING = {"E": "error", "W": "warning", "I": "note"}
WALKED = {"active": "at the shown step", "visited": "at an earlier step",
          "next": "at a later step"}  # fmt: skip
"""Words for the states of a run that is only looked at, where nothing is active."""


def edge_tip(canvas: Stage, edge: int) -> str:
    """The tooltip of an operation: its name, its source and target, and the facts it requires.

    During a run it also says whether these facts hold.
    """
    sheet = canvas.sheet
    assert sheet is not None
    picture, address = sheet.picture, sheet.picture.address(edge)
    target = picture.branch.table[address.state][address.operation]
    told = canvas.marks.guards.get(address, ("", ""))[1]
    needs = told or needs_words(picture.guards(edge))
    lines = [address.operation, f"{address.state} to {target}", needs[:1].upper() + needs[1:]]
    return "\n".join(line for line in lines if line)


def words_for(canvas: Stage, address: Address) -> str:
    """A state or operation in words: "State_1100, active, 7 operations out"."""
    sheet = canvas.sheet
    if sheet is None:
        return ""
    edge = sheet.picture.edge(address)
    if edge >= 0:
        target = sheet.picture.branch.table[address.state][address.operation]
        words = [f"{address.operation}, {address.state} to {target}"]
        look = sheet.looks.edge(edge)
        words += [
            key.replace("_", " ")
            for key in ("selected", "planned", "pruned", "held_back", "risky")
            if getattr(look, key)
        ]
        if look.running is not None:
            words.append(WALKED["active"] if canvas.marks.walked else "running")
        if look.finding:
            words.append(FINDING.get(look.finding, "finding"))
        bends = len(sheet.lines[edge].bends) if edge in sheet.lines else 0
        words += [f"{bends} bend{'' if bends == 1 else 's'}"] * bool(bends)
        how = sheet.looks.guard(edge)
        needs = needs_words(sheet.picture.guards(edge))
        words += [said for said in (needs, WORDS.get(how, "")) if said]
        return ", ".join(words)
    state = sheet.picture.node(address)
    if state < 0:
        return str(address)
    return state_words(canvas, state)


def state_words(canvas: Stage, state: int) -> str:
    """The words for a state, such as "State_1100, active, 7 operations out, 1 loop".

    A loop leads back to its own state, so it leads nowhere else and is counted apart.
    """
    sheet = canvas.sheet
    assert sheet is not None
    face, look = sheet.picture.face(state), sheet.looks.node(state)
    words = [face.name]
    for key in ("active", "selected", "visited", "next", "goal"):
        if getattr(look, key):
            words.append(WALKED.get(key, key) if canvas.marks.walked else key)
    words += ["initial"] if face.initial else []
    words += ["activating"] if face.activating else []
    if look.finding:
        words.append(FINDING.get(look.finding, "finding"))
    targets = sheet.picture.branch.table[face.name].values()
    loops = sum(target == face.name for target in targets)
    words.append(f"{counted(len(targets) - loops, 'operation')} out")
    words += [counted(loops, "loop")] if loops else []
    return ", ".join(words)
