"""The canvas for assistive tools: every state as a child with a name and a place."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address

if TYPE_CHECKING:
    from smsl_studio.studio.canvas.canvas import Canvas

FINDING = {"E": "error", "W": "warning", "I": "note"}


def words_for(canvas: Canvas, address: Address) -> str:
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
            words.append("running")
        if look.finding:
            words.append(FINDING.get(look.finding, "finding"))
        return ", ".join(words)
    state = sheet.picture.node(address)
    if state < 0:
        return str(address)
    return state_words(canvas, state)


def state_words(canvas: Canvas, state: int) -> str:
    """A state in words."""
    sheet = canvas.sheet
    assert sheet is not None
    face, look = sheet.picture.face(state), sheet.looks.node(state)
    words = [face.name]
    for key in ("active", "selected", "visited", "next", "goal"):
        if getattr(look, key):
            words.append(key)
    words += ["initial"] if face.initial else []
    words += ["activating"] if face.activating else []
    if look.finding:
        words.append(FINDING.get(look.finding, "finding"))
    out = len(sheet.picture.branch.table[face.name])
    words.append(f"{out} operation{'' if out == 1 else 's'} out")
    return ", ".join(words)
