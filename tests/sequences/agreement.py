"""Checks that all parts of a window show the same drawing."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.graph.layout import place_states
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.outline_nodes import OutlineNodes
from smsl_studio.studio.features.draw.panels.outline_tree import line_of
from smsl_studio.studio.features.draw.source.sheet import TextSheet
from smsl_studio.studio.shell.window import Window
from tests.blueprint.histories import as_read, stand
from tests.stories.at_outline import everything

Places = dict[str, tuple[float, float]]


def rounded(places: Places) -> Places:
    """Places as a file has them, in tenths of a pixel."""
    return {name: (round(x, 1), round(y, 1)) for name, (x, y) in places.items()}


def seen(session: Session) -> dict[str, Places]:
    """Where the window shows the states of every SB."""
    return {one.name: rounded(session.places.shown(one)) for one in session.blueprint}


def as_opened(blueprint: Blueprint) -> dict[str, Places]:
    """Where a window that opens a blueprint shows the states of every SB."""
    return {one.name: rounded(place_states(one)) for one in blueprint}


def disagreements(window: Window, path: Path) -> Iterator[str]:
    """Everything in which what is shown differs, in words."""
    session = window.session
    # As for a key or a click, which finds all parts as they should be.
    session.afterwards.catch_up()
    if stand(as_read(session.blueprint)) != stand(session.blueprint):
        yield "the text does not mean the blueprint"
    if session.texts != {one.file: one.text for one in session.blueprint.documents}:
        yield "the session's texts are not those of the blueprint"
    yield from _canvas(window)
    yield from _selection(window)
    yield from _title(window, path)
    yield from _panels(window)
    yield from _run(window)


def _canvas(window: Window) -> Iterator[str]:
    session, canvas = window.session, window.canvas
    branch = session.blueprint.branches.get(session.branch)
    if branch is None:
        if canvas.sheet is not None:
            yield "the canvas draws an SB that is not there"
        return
    yield from _drawn(canvas, branch, "canvas", branch)
    assert canvas.sheet is not None
    if canvas.sheet.picture.blueprint is not session.blueprint:
        yield "the canvas draws another blueprint"
    if rounded(canvas.positions) != rounded(session.places.shown(branch)):
        yield "states are drawn elsewhere than the session says"
    if canvas.sheet.lines != canvas.sheet.picture.edge_layouts():
        yield "lines are drawn otherwise than the blueprint says"
    if window.editor.field is not None:
        yield "a field is open"
    if window.features.draw.notes.field is not None:
        yield "the field of a note is open"
    chosen = canvas.drawn.chosen
    if chosen is not None and (session.selection or canvas.sheet.drawn.number(chosen) < 0):
        yield "a note or group is selected that does not stand, or beside states"
    item = {canvas.sheet.picture.names[i] for i in canvas.pool.used}
    if not item <= branch.table.keys():
        yield "an item is drawn for a state that is not there"


def _drawn(canvas: Canvas, branch: StateBranch, where: str, placed: StateBranch) -> Iterator[str]:
    """What differs between a canvas and the SB it draws, in the places of ``placed``."""
    sheet = canvas.sheet
    if sheet is None:
        yield f"the {where} is empty"
        return
    picture = sheet.picture
    if picture.branch is not branch and picture.branch != branch:
        yield f"the {where} draws {picture.branch.name}, not {branch.name} as it is"
    if picture.names != tuple(branch.table):
        yield f"the {where} draws other states"
        return
    names = (*picture.names, "")
    edges = [
        (names[source], operation, names[target])
        for source, operation, target in zip(
            picture.source.tolist(), picture.operations, picture.target.tolist(), strict=True
        )
    ]
    there = [
        (state, operation, target if target in branch.table else "")
        for state, row in branch.table.items()
        for operation, target in row.items()
    ]
    if edges != there:
        yield f"the {where} draws other operations"
    for state, at in placed.notes.layout.items():
        if state in branch.table and rounded({"": canvas.positions[state]}) != rounded({"": at}):
            yield f"{state} is not drawn where the {where}'s file has it"


def _selection(window: Window) -> Iterator[str]:
    session, canvas, form = window.session, window.canvas, window.properties
    chosen = session.selection
    for one in chosen:
        table = session.blueprint.branches[one.branch].table if (
            one.branch in session.blueprint.branches) else {}  # fmt: skip
        if one.state not in table or (one.operation and one.operation not in table[one.state]):
            yield f"{one} is selected and does not stand"
    if canvas.marks.selection != chosen:
        yield "the canvas marks another selection"
    if canvas.sheet is not None:
        picture, looks = canvas.sheet.picture, canvas.sheet.looks
        lit = {picture.address(e) for e in range(len(picture.operations)) if looks.edge(e).selected}
        lit |= {Address(session.branch, name) for i, name in enumerate(picture.names)
                if looks.node(i).selected}  # fmt: skip
        if lit != {one for one in chosen if one.branch == session.branch}:
            yield "the canvas lights another selection"
    states = [one for one in chosen if not one.operation]
    edges = [one for one in chosen if one.operation]
    shown = (not form.fact.isHidden(), not form.state.isHidden(), not form.operation.isHidden(),
             not form.several.isHidden())  # fmt: skip
    wanted = (session.fact is not None, bool(states) and not edges, bool(edges) and not states,
              len(chosen) > 1)  # fmt: skip
    if shown != wanted:
        yield f"Properties shows {shown}, and {wanted} is selected"
    if len(states) == 1 and not edges and _typed(form.state) != states[0].state:
        yield f"Properties names {_typed(form.state)!r}"
    if len(edges) == 1 and not states and _typed(form.operation) != edges[0].operation:
        yield f"Properties names {_typed(form.operation)!r}"


def _typed(form: object) -> str:
    return str(form.naming.field.text())  # type: ignore[attr-defined]


def _title(window: Window, path: Path) -> Iterator[str]:
    session, mode = window.session, window.mode
    texts = session.texts[session.blueprint.file]
    words = path.name
    if path.read_bytes().decode() != texts:
        words += " (edited)"
    pane = window.features.run.pane
    if mode != "draw" and pane.run.foreign and pane.run.shown:
        words = path.name
    if window.windowTitle() != f"{words} · SMSL Studio":
        yield f"the title is {window.windowTitle()!r}, and should be of {words!r}"
    if window.menu_row.title != words.replace("(edited)", "edited"):
        yield f"the row says {window.menu_row.title!r}, and should say {words!r}"


def _panels(window: Window) -> Iterator[str]:
    session, blueprint = window.session, window.session.blueprint
    tree = window.outline.tree
    listed = everything(OutlineNodes(blueprint))
    if everything(tree.lines.nodes) != listed:
        yield "the outline lists other lines"
    chosen = [line_of(one) for one in tree.selectedIndexes()]
    marked = [(one.branch, one.digit) for one in chosen]
    wanted = [session.fact or (session.branch, None)] if blueprint.branches else []
    if session.fact is not None and wanted[0] not in {(one.branch, one.digit) for _, one in listed}:
        # Names that are words show no facts: then the line of the SB stands for the fact.
        wanted = [(session.fact[0], None)]
    if marked != wanted:
        yield f"the outline marks {marked}, not {wanted}"
    if blueprint.branches:
        for combo in (window.properties.header.initial, window.properties.header.activating):
            choices = [combo.itemText(at) for at in range(1, combo.count())]
            if choices != list(blueprint[session.branch].table):
                yield f"the header offers {choices}"
    counts = [part.text() for part in window.status_line.counts[:3]]
    numbers = [len(blueprint), blueprint.state_count, blueprint.operation_count]
    if [int(words.split()[0].replace(",", "")) for words in counts] != numbers:
        yield f"the status line says {counts}, not {numbers}"
    source = window.source
    if source.isVisible():
        text = session.texts.get(source.file, "")
        if source.editor.sheet.text != text or source.editor.toPlainText() != TextSheet(text).shown:
            yield "the source shows another text"
    history, row = session.history, window.history.currentIndex().row()
    if row != history.index() or window.history.model().rowCount() != history.count() + 1:
        yield f"History marks row {row}, not {history.index()}"
    table = window.actions_table
    if table["undo"].isEnabled() != history.canUndo():
        yield "Undo is offered where there is none, or not where there is"
    if table["redo"].isEnabled() != history.canRedo():
        yield "Redo is offered where there is none, or not where there is"
    said = window.canvas.accessibleDescription()
    here = [one for one in session.selection if one.branch == session.branch]
    name = here[0].path[-1] if len(here) == 1 else session.branch
    if window.canvas.drawn.chosen is not None:
        name = window.canvas.drawn.chosen.kind.capitalize()
    if not said.startswith(name) and window.canvas.positions:
        yield f"the canvas is read out as {said!r}, not as {name!r}"


def _run(window: Window) -> Iterator[str]:
    """The canvas of Run mode draws the run's version, else the drawing, and in its places."""
    pane = window.features.run.pane
    if window.mode != "run":
        return
    run, session = pane.run, window.session
    held = run.blueprint if run.shown and run.blueprint is not None else session.blueprint
    branch = held.branches.get(pane.canvas.branch)
    if branch is None:
        yield f"Run mode shows the SB {pane.canvas.branch!r}"
        return
    # A state that was moved makes no other drawing: the run shows it where it is now.
    placed = branch if run.is_another(session.blueprint) else session.blueprint[branch.name]
    yield from _drawn(pane.canvas.canvas, branch, "run's canvas", placed)
    same = session.blueprint.branches.get(branch.name)
    if held == session.blueprint and not run.foreign and same is not None and branch.notes.layout:
        drawn = rounded(session.places.shown(same))
        if rounded(pane.canvas.canvas.positions) != drawn:
            yield "Run mode shows states elsewhere than the drawing"
