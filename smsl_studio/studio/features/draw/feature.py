"""Draw mode as one feature: canvas, panels, source, search, comparison and unsaved work."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QDialog, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import StudioError
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.feature import (
    Coloured,
    Control,
    DockPanel,
    Feature,
    Page,
    Shell,
    whole,
)
from smsl_studio.studio.base.passing_menu import passing_menu
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.document.files.menus import fill_recent, fill_samples
from smsl_studio.studio.document.journal.entry import JournalEntry
from smsl_studio.studio.features.draw.canvas.align_verbs import AlignVerbs, fill_align
from smsl_studio.studio.features.draw.canvas.bend_verbs import bend_actions
from smsl_studio.studio.features.draw.canvas.clipboard import ClipboardVerbs
from smsl_studio.studio.features.draw.canvas.context_menu import context_menu
from smsl_studio.studio.features.draw.canvas.draw_verbs import DrawVerbs
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.canvas.fix_card import FixCard
from smsl_studio.studio.features.draw.canvas.library_verbs import (
    LibraryVerbs,
    fill_templates,
    template_actions,
)
from smsl_studio.studio.features.draw.canvas.message_seat import MessageSeat
from smsl_studio.studio.features.draw.canvas.pin_verbs import PinVerbs, pin_actions
from smsl_studio.studio.features.draw.canvas.state_copy import StateCopy
from smsl_studio.studio.features.draw.canvas.sub_sb_menu import fill_sub_sbs
from smsl_studio.studio.features.draw.compare.comparison import Comparison
from smsl_studio.studio.features.draw.consequences import Consequences
from smsl_studio.studio.features.draw.drawn.drawn_copies import DrawnCopies
from smsl_studio.studio.features.draw.drawn.drawn_editor import DrawnEditor
from smsl_studio.studio.features.draw.drawn.drawn_verbs import DrawnVerbs, drawn_actions, fill_drawn
from smsl_studio.studio.features.draw.facts.panel import Facts
from smsl_studio.studio.features.draw.find.bar import DrawingFindBar
from smsl_studio.studio.features.draw.find.destinations import Destinations
from smsl_studio.studio.features.draw.find.drawing_search import DrawingSearch
from smsl_studio.studio.features.draw.find.finder import Finder
from smsl_studio.studio.features.draw.find.palette import Palette
from smsl_studio.studio.features.draw.menus.blueprint import blueprint_actions
from smsl_studio.studio.features.draw.menus.compare import compare_actions
from smsl_studio.studio.features.draw.menus.edit import NOT_SHOWN, edit_actions
from smsl_studio.studio.features.draw.menus.files import file_actions
from smsl_studio.studio.features.draw.menus.samples import sample_actions
from smsl_studio.studio.features.draw.menus.shapes import shape_actions
from smsl_studio.studio.features.draw.menus.view import view_actions
from smsl_studio.studio.features.draw.menus.walk import walk_actions
from smsl_studio.studio.features.draw.panels.branch_table import BranchTable
from smsl_studio.studio.features.draw.panels.findings import Findings
from smsl_studio.studio.features.draw.panels.history import History
from smsl_studio.studio.features.draw.panels.library import Library
from smsl_studio.studio.features.draw.panels.offers import offers, operation_names
from smsl_studio.studio.features.draw.panels.outline import Outline
from smsl_studio.studio.features.draw.panels.properties import Properties
from smsl_studio.studio.features.draw.safety.safety import Safety
from smsl_studio.studio.features.draw.shape.shape_verbs import ShapeVerbs
from smsl_studio.studio.features.draw.source.keys import SOURCE_KEYS
from smsl_studio.studio.features.draw.source.pane import SourcePane
from smsl_studio.studio.features.draw.tidings import Tidings
from smsl_studio.studio.running.window_parts import WindowParts

CANVAS_KEYS = (
    ("Add an operation from the selected state, or go on from its new state", "Tab or /"),
    ("Add a sibling of the selected operation or state", "Shift+Tab"),
    ("Pan", "Space and drag, or the middle button"),
    ("Zoom", "Mouse wheel"),
    ("Add a state there", "Double click on empty canvas"),
    ("Connect", "Drag from a state's handle"),
    ("Move the selected states", "Arrows; with Shift by one pixel"),
    ("Drag without snapping to grid and states", "Alt"),
    ("Bend the selected operation, move its label", "Drag its line, its label"),
    ("Remove a bend", "Double click on its handle"),
    ("Select the next state", "Ctrl and an arrow; with Shift it is added"),
    ("Select several", "Drag over empty canvas, Shift and click"),
    ("Edit a selected note, or the title of a selected group", "Enter or F2"),
)


class DrawFeature(Feature):
    """Draw mode with its panels."""

    keys = (("On the canvas", CANVAS_KEYS), ("In the source", SOURCE_KEYS))

    def __init__(self, parts: WindowParts, shell: Shell) -> None:
        session, files, tokens, window = parts.session, parts.files, parts.tokens, parts.window
        self._parts, self._shell, self._loaded = parts, shell, Loaded()
        self.canvas = Canvas(tokens)
        self.canvas.collapse.join(parts.collapse)
        self.editor = CanvasEditor(session, self.canvas)
        self.drawing = DrawVerbs(session, self.editor)
        self.align = AlignVerbs(self.editor)
        self.clipping = ClipboardVerbs(
            session, self.canvas, parts.toast.say, StateCopy(self.editor)
        )
        self.notes = DrawnEditor(session, self.canvas)
        self.clipping.drawn = DrawnCopies(session, self.canvas, self.notes)
        self.outline, self.library = Outline(session, tokens), Library(session, tokens)
        self.using = LibraryVerbs(self.editor)
        self.library.use = self.using.use
        self.facts = Facts(session, tokens)
        self.drawing.add_fact = self._add_fact
        self.properties, self.source = Properties(session, tokens), SourcePane(session, tokens)
        self.findings = Findings(session, tokens, parts.inspector.rules)
        self.history, self.table = History(session, tokens), BranchTable(session, tokens)
        self.fix_card = FixCard(session, self.canvas, tokens)
        dialogs = Dialogs(window)
        self.properties.file.ask_file = dialogs.file_to_import
        self.comparing = Comparison(session, files, dialogs.file_to_compare, tokens, window)
        self.shapes = ShapeVerbs(session, self.canvas, window)
        self.comparing.wish = parts.collapse.wish
        self.safety = Safety(parts, self.source, self.comparing.with_version)
        self.going = Destinations(shell, self.properties, self.library, files)
        bar = DrawingFindBar(tokens)
        self.search = DrawingSearch(session, self.canvas, bar, parts.inspector, self.going)
        self.search.offered = lambda: self.library.offered
        self.search.show_drawn = self.notes.show
        self.pages = {"draw": lambda: Page(_below(self.search.bar, self.canvas), self.canvas)}
        self.panels = (
            DockPanel("Outline", "left", self.outline, focus=self.outline.tree),
            DockPanel("Facts", "left", self.facts, self.facts.tools),
            DockPanel("Library", "left", self.library, self.library.tools),
            DockPanel("Properties", "right", self.properties),
            DockPanel("Source", "right", self.source),
            DockPanel("Findings", "bottom", self.findings, self.findings.tools),
            DockPanel("History", "bottom", self.history),
            DockPanel("Table", "bottom", self.table),
        )
        self.submenus = {
            "open": ("Open recent", lambda menu: fill_recent(files, menu)),
            "new": ("Open sample", lambda menu: fill_samples(files.open_copy, menu)),
            "sub_sb": ("Insert template", lambda menu: fill_templates(self._actions, menu)),
        }

    def actions(self) -> tuple[Action, ...]:
        """The rows of the File, Edit, View and Blueprint menus."""
        session, files, shell = self._parts.session, self._parts.files, self._shell
        return (
            *file_actions(files, session, shell.program, shell, self._parts.window.close),
            *sample_actions(files),
            *edit_actions(session, self.drawing, self.clipping, self.search, shell),
            *bend_actions(self.editor.bends, lambda: shell.mode == "draw"),
            *pin_actions(PinVerbs(session, self.canvas), lambda: shell.mode == "draw"),
            *view_actions(self.drawing, shell.sides, shell.program, shell),
            *walk_actions(self.canvas, lambda: shell.mode == "draw"),
            *blueprint_actions(
                self.drawing,
                self.findings,
                self._choose_sub_sb,
                self.align,
                self._choose_align,
                shell,
            ),
            *template_actions(self.using, shell),
            *drawn_actions(DrawnVerbs(session, self.canvas, self.notes), self.notes,
                           lambda: shell.mode == "draw"),
            *shape_actions(self.shapes, lambda: shell.mode == "draw"),
            *compare_actions(self.comparing),
        )  # fmt: skip

    def take_actions(self, actions: Actions) -> None:
        """Build what needs the actions (palette, tidings) and connect all signals."""
        parts, session = self._parts, self._parts.session
        self._actions = actions
        finder = Finder(session, actions, self.findings, self.going)
        self.palette = Palette(finder, parts.tokens, parts.window)
        marked = (self.outline, self.library, self.source, self.fix_card, self.table)
        say = self._shell.say_findings
        self.tidings = Tidings(parts, self.findings, self.editor, marked, say, actions.refresh)
        for running in ("run_play", "run_step"):
            actions[running].triggered.connect(self.tidings.check)
        self._follow_session()
        self._connect_parts(actions)

    def _follow_session(self) -> None:
        session = self._parts.session
        session.blueprint_changed.connect(lambda *_: self._show_offers())
        session.opened.connect(self.tidings.forget)
        session.opened.connect(self._parts.toast.hide)
        session.opened.connect(self.canvas.setFocus)
        session.opened.connect(self.canvas.collapse.forget)
        session.jumped.connect(self._jumped)
        session.stepped.connect(lambda _: self._parts.toast.edited())
        self.editor.views.told.connect(lambda words: self._parts.toast.of_step(words, ""))
        session.broken_changed.connect(self._show_broken)
        session.refused.connect(self._refused)
        self._consequences = Consequences(session, self._parts.toast, self._parts.window)
        session.selection_changed.connect(self._spare_selected)
        toast, canvas = self._parts.toast, self.canvas
        toast.seat = MessageSeat(canvas, toast.over)
        for moved in (canvas.view_moved, canvas.picture_changed, canvas.overlays.word.placed):
            moved.connect(toast.settle)
        self.editor.field_opened.connect(toast.settle)

    def _connect_parts(self, actions: Actions) -> None:
        shell, toast, comparing = self._shell, self._parts.toast, self.comparing
        comparing.refused.connect(toast.refuse)
        comparing.element_shown.connect(lambda _: shell.set_mode("draw"))
        comparing.element_shown.connect(self._jumped)
        comparing.said.connect(toast.say)
        self.shapes.said.connect(toast.say)
        comparing.changed.connect(actions.refresh)
        self.findings.count_changed.connect(lambda count: shell.show_count("Findings", count))
        self.drawing.ways.told.connect(self._tell_ways)
        self.properties.text_lost.connect(toast.bring_back)
        self.properties.ways_wanted.connect(actions["show_ways"].trigger)
        for line in (self.properties, self.properties.line, self.properties.state.notes.place):
            line.verb_wanted.connect(lambda name: actions[name].trigger())
        self.fix_card.fix_wanted.connect(self.findings.fix)
        for panel in (self.outline, self.facts):
            panel.fact_wanted.connect(self.going.show_fact)
        self.outline.file_wanted.connect(lambda file: self._parts.files.open(Path(file)))
        self.outline.verb_wanted.connect(self.clipping.on_branch)
        for acting in (self.outline, self.table):
            acting.action_wanted.connect(lambda name: actions[name].trigger())
        self.table.shown_wanted.connect(self.canvas.reveal)
        self.outline.branch_deleted.connect(self._say_deleted)
        self.drawing.values.fact_wanted.connect(self.going.show_fact)
        self.properties.state.values_wanted.connect(self.drawing.values.open)
        self.canvas.verb_wanted.connect(lambda name: actions[name].trigger())
        self.canvas.context_wanted.connect(self._open_context_menu)
        self.canvas.drawn_menu_wanted.connect(self._open_drawn_menu)
        self.notes.chosen_changed.connect(actions.refresh)
        self.notes.chosen_changed.connect(lambda: self.properties.show_drawn(self.notes.chosen))
        self.properties.state.notes.note_wanted.connect(self._note_on)
        self.canvas.overlays.empty.sample_wanted.connect(self._offer_samples)

    # Called by the shell.

    def control(self, name: str) -> Control | None:
        """The first finding, its place on the canvas, and the card with its fix."""
        if name == "finding":
            rows = self.findings.list
            return rows.viewport(), rows.visualRect(rows.model().index(0, 0))
        if name == "found" and self.findings.findings:
            place = self.canvas.place_of(self.findings.findings[0].address)
            view = self.canvas.viewport()
            return view, QRect(view.mapFromGlobal(place.topLeft()), place.size())
        return whole(self.fix_card) if name == "fix" else None

    def mode_shown(self) -> None:
        """Take away what was said while the drawing was not shown."""
        toast = self._parts.toast
        if self._shell.mode == "draw" and toast.words.casefold().startswith(NOT_SHOWN.sentence):
            toast.hide()

    def set_plugins(self, loaded: Loaded, known: bool) -> None:
        """Offer the operations of the plugins in the library, the source and the forms."""
        self._loaded = loaded
        self._show_offers()
        self.source.set_library(operation_names(loaded))
        self.properties.set_plugins(loaded)
        self.editor.warning.loaded = loaded
        self.facts.loaded = loaded

    def settle(self) -> None:
        """Take over the text that is being typed in the source, and arrow keys that wait."""
        self.source.settle()
        self.editor.nudge.settle()
        self.editor.bends.settle()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        canvas, bar = self.canvas, self.search.bar
        for part in (canvas, bar, self.palette, self.fix_card, self.comparing, self.safety):
            part.set_tokens(tokens)
        for panel in self.panels:
            if isinstance(panel.widget, Coloured):
                panel.widget.set_tokens(tokens)

    def stop(self) -> None:
        """End all background work of the drawing, because the window closes."""
        tidying = self.drawing.beside
        parts = (self.source, self.comparing, self.findings, self.clipping, self.properties,
                 tidying, self.shapes)  # fmt: skip
        for part in parts:
            part.stop()
        self.safety.close()

    def show_difference(self, entry: JournalEntry, tokens: Tokens, parent: QDialog) -> bool:
        """Compare the kept text with the file on the disk; False if nothing can be compared."""
        from smsl_studio.studio.features.draw.compare.kept_difference import difference_dialog

        return difference_dialog(entry, tokens, parent)

    # Reactions to the session.

    def _show_offers(self) -> None:
        self.library.set_offers(offers(self._loaded, self._parts.session.blueprint))

    def _show_broken(self) -> None:
        """Show the source if the text cannot be read, because its faults are marked there."""
        if self._parts.session.broken is not None and self._shell.mode == "draw":
            self._shell.show_tab("Source")

    def _spare_selected(self, selection: tuple[Address, ...]) -> None:
        """Let no message cover a selected element, nor the state to which it leads."""
        shown = self.canvas.place_of(selection[0]) if len(selection) == 1 else QRect()
        self._parts.toast.spare(shown)

    def _jumped(self, address: Address) -> None:
        """Scroll the canvas to an element that was found, and give it the keyboard focus."""
        self.canvas.reveal(address)
        if self._shell.mode == "draw":
            self.canvas.setFocus()

    def _tell_ways(self, words: str, asked: bool) -> None:
        """Tell the ways between two states in Properties, or over the canvas if these are not
        shown."""
        self.properties.several.show_ways(words)
        if asked and not self.properties.isVisible():
            self._parts.toast.say(words)

    def _say_deleted(self, name: str, states: int) -> None:
        """Say that a whole SB was deleted, and offer to undo that."""
        words = f"Deleted State Branch {name} with {counted(states, 'state')}."
        self._parts.toast.offer(words, "Undo", self._parts.session.history.undo)

    def _refused(self, error: StudioError) -> None:
        """Show a refused edit in a toast, unless the open name field shows the reason itself."""
        if self.editor.field is None:
            self._parts.toast.refuse(error)

    def _open_context_menu(self, address: Address | None, at: QPoint) -> None:
        session, actions = self._parts.session, self._actions
        context_menu(session, self.editor, actions, self.clipping, address).popup(at)

    def _open_drawn_menu(self, key: DrawnKey, at: QPoint) -> None:
        menu = passing_menu(self._parts.window, "Menu of the note or group")
        fill_drawn(self._actions, key, menu)
        menu.popup(at)

    def _note_on(self, address: Address, key: str) -> None:
        """Show a note on a state, or ask for the first one."""
        self._parts.session.show_branch(address.branch)
        if key:
            self.notes.show(DrawnKey("note", key))
            self.canvas.setFocus()
        else:
            self.notes.add_note(state=address.state)

    def _add_fact(self) -> None:
        """Show the panel of facts, and tell there what one more fact changes."""
        self._shell.sides.enter_tab("Facts")
        self.facts.propose_addition()

    def _choose_sub_sb(self) -> None:
        """Open the menu of facts, with the SBs that could expand each of them."""
        menu = passing_menu(self._parts.window, "Facts that a sub-SB can expand")
        fill_sub_sbs(self._parts.session, self.drawing, menu)
        menu.popup(self._shell.corner_below("sub_sb"))

    def _choose_align(self) -> None:
        """Open the menu of all ways to arrange the selected states."""
        menu = passing_menu(self._parts.window, "Align")
        fill_align(self._actions, menu)
        menu.popup(self._shell.corner_below("align"))

    def _offer_samples(self) -> None:
        """Open the menu of the samples. No sample is opened at once, because the hint also stands
        in an empty SB of a drawing, and the sample would replace that drawing."""
        files, menu = self._parts.files, passing_menu(self._parts.window, "Samples")
        drawn = any(branch.table for branch in self._parts.session.blueprint)
        here = files.is_draft and not drawn
        fill_samples(files.open_copy if here else self._shell.copy_beside, menu)
        button = self.canvas.overlays.empty.sample
        menu.popup(button.mapToGlobal(QPoint(0, button.height() + 4)))


def _below(bar: QWidget, canvas: QWidget) -> QWidget:
    """The page of the drawing: a bar above the canvas."""
    page = QWidget()
    column = QVBoxLayout(page)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(0)
    column.addWidget(bar)
    column.addWidget(canvas, 1)
    return page
