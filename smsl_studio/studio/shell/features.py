"""The table of features of a window, and what each gets from the others."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPoint, Signal
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.features.approval.feature import ApprovalFeature
from smsl_studio.studio.features.branch_map.feature import BranchMapFeature
from smsl_studio.studio.features.campaign.feature import NAME, CampaignFeature
from smsl_studio.studio.features.design.feature import DesignFeature
from smsl_studio.studio.features.draw.feature import DrawFeature
from smsl_studio.studio.features.exchange.feature import ExchangeFeature
from smsl_studio.studio.features.export.feature import ExportFeature
from smsl_studio.studio.features.help.feature import HelpFeature
from smsl_studio.studio.features.inspection.feature import InspectionFeature
from smsl_studio.studio.features.merge.feature import MergeFeature
from smsl_studio.studio.features.monitor.feature import MonitorFeature
from smsl_studio.studio.features.people.feature import PeopleFeature
from smsl_studio.studio.features.physics.feature import PhysicsFeature
from smsl_studio.studio.features.planning.feature import PlanningFeature
from smsl_studio.studio.features.replay.feature import ReplayFeature
from smsl_studio.studio.features.replay.watched import Watched
from smsl_studio.studio.features.review.feature import ReviewFeature
from smsl_studio.studio.features.room.feature import RoomFeature
from smsl_studio.studio.features.rules.feature import BY_RULES, RulesFeature
from smsl_studio.studio.features.run.feature import RunFeature
from smsl_studio.studio.features.settings.feature import SettingsFeature
from smsl_studio.studio.features.start.feature import StartFeature
from smsl_studio.studio.features.supervise.feature import SuperviseFeature
from smsl_studio.studio.features.tour.feature import TourFeature
from smsl_studio.studio.running.window_parts import WindowParts
from smsl_studio.studio.shell.windows import Windows

if TYPE_CHECKING:
    from smsl_studio.studio.features.inspection.panel import InspectionPanel
    from smsl_studio.studio.features.replay.playback import ReplayVerbs
    from smsl_studio.studio.features.room.page import RoomPage
    from smsl_studio.studio.features.run.pane import RunPane
    from smsl_studio.studio.running.next_levels import NextLevels
    from smsl_studio.studio.running.run_session import RunSession
    from smsl_studio.studio.running.status_words import Words


class Features(QObject):
    """All features of one window. Iterating yields them in the order of their menus.

    The drawing is made at once. The parts of a run are made together when one of them is needed.
    The replay is made when the first recording is opened.
    """

    said = Signal()
    """The result of ``words`` changed."""
    named = Signal()
    """The result of ``other`` may have changed."""
    caret_moved = Signal(int, int)
    """Line and column of the caret in the source, from 1."""
    run_exists = Signal(bool)
    """Whether there is a run that can be stopped."""
    phase_shown = Signal(str, str, str, str)
    """The word for the run's phase, its kind (which selects the colour), the sentence about it,
    and its file if that is not the file of the drawing."""

    def __init__(self, parts: WindowParts, shell: Shell, windows: Windows) -> None:
        super().__init__(parts.window)
        self._shell, self._inspector, self._parts = shell, parts.inspector, parts
        self.draw = DrawFeature(parts, shell)
        self.draw.notes.author = windows.persons.author
        self.inspection = InspectionFeature(parts, shell, self.draw.canvas)
        self.draw.findings.claim_wanted.connect(self.inspection.show_claim)
        self.draw.going.show_claim = self.inspection.show_claim
        self.draw.properties.claims.wanted.connect(self.inspection.show_page)
        self.export = ExportFeature(parts, shell, self.draw.canvas)
        self.exchange = ExchangeFeature(parts, shell)
        self.branch_map = BranchMapFeature(parts, shell)
        self.approval = ApprovalFeature(parts)
        self.export.trust = lambda: self.approval.badge.said
        self.approval.compare = self.draw.comparing.with_signed
        self.approval.store.told = self.draw.library.set_stored
        self.merge = MergeFeature(parts, shell)
        self.rules, self.planning, self.physics = (
            RulesFeature(parts, shell),
            PlanningFeature(parts, shell, BY_RULES),
            PhysicsFeature(parts, shell, BY_RULES),
        )
        self.design = DesignFeature(parts, shell, BY_RULES)
        self.start = StartFeature(parts, shell)
        self.help = HelpFeature(parts, shell, lambda: self.draw.findings.chosen_rule)
        self.settings = SettingsFeature(parts, shell)
        self.tour = TourFeature(parts, shell, self.help.show_first)
        self.run = RunFeature(parts, shell, windows.spare, windows.persons)
        self.monitor = MonitorFeature(self._run_in_front, parts.tokens, shell, self._room_page)
        self.room = RoomFeature(lambda: self.run.pane.run, parts.tokens)
        self.room.disturb = self.monitor.show_sensors
        self.room.edit = self._edit_fact
        self.campaign = CampaignFeature(parts, shell)
        self.run.further[NAME] = self.campaign.part
        self.run.further["Monitor"] = self.monitor.inside
        self.run.rows[NAME] = self.campaign.row
        self.run_exists.connect(self.campaign.show_run)
        self.campaign.show_page = self.run.show_page
        self.monitor.toggle_page, self.monitor.show_page = self.run.toggle_page, self.run.show_page
        self.supervise = SuperviseFeature(parts, shell, lambda: self.run.pane.run)
        self.people = PeopleFeature(parts, shell, self._run_and_levels, windows.persons)
        self.replay = ReplayFeature(parts, shell, lambda: self.draw.safety.untouched)
        self.review = ReviewFeature(parts, shell, windows.persons)
        self._connect_review()
        self.inspection.play = self._play_script
        self.inspection.start_at = self._start_at
        self._connect_shapes()
        self.campaign.replay = lambda path: self.replay.verbs.open(path)
        self.run.asked = Watched(self.run, self.replay, lambda: shell.mode, self._page_with_keys)
        self.run.shown_elsewhere = self.supervise.is_shown
        self.run.part.when_made(self._introduce)
        self.replay.part.when_made(self._introduce_replay)
        windows.persons.changed.connect(self.supervise.refresh)
        self.draw.source.caret_moved.connect(self.caret_moved)

    def __iter__(self) -> Iterator[Feature]:
        yield from (self.draw, self.inspection, self.approval, self.merge, self.branch_map)
        yield from (self.rules, self.planning, self.physics, self.design)
        yield from (self.start,)
        yield from (self.exchange, self.export, self.run, self.supervise, self.review)
        yield from (self.people, self.monitor, self.room, self.campaign)
        yield from (self.replay, self.tour, self.help, self.settings)

    def _page_with_keys(self) -> CampaignFeature | None:
        """The page of Run that takes the keys of a run: the campaign, while no run moves."""
        body = self.run.body
        shown = self._shell.mode == "run" and body is not None and body.shown == NAME
        return self.campaign if shown and not self.run.moves else None

    def _room_page(self) -> RoomPage:
        return self.room.page

    def _edit_fact(self, branch: str, digit: int) -> None:
        """Show the form of a fact in Draw, if its SB is drawn there."""
        if branch in self._parts.session.blueprint.branches:
            self._shell.set_mode("draw")
            self.draw.going.show_fact(branch, digit)

    def _run_in_front(self) -> tuple[RunSession, QWidget]:
        return self.run.pane.run, self.run.pane

    def _play_script(self, text: str, name: str) -> None:
        self._shell.set_mode("run")
        self.run.pane.play_script(text, name)

    def _connect_review(self) -> None:
        """Let Review sign, play steps, and ask the engineer in Draw."""
        review = self.review
        self.approval.told = review.show_approval
        review.signed = self.approval.look_again
        review.change_person = self.people.edit_persons
        review.play = self.run.play_step
        review.run = lambda: self.run.pane.run
        review.asked_changed = self._show_asked
        review.words_changed = self.said.emit
        self.draw.findings.asked_wanted.connect(review.answer)

    def _show_asked(self) -> None:
        """Show the open comments of the review among the findings."""
        tidings = self.draw.tidings
        tidings.asked = self.review.asked
        tidings.show_asked()

    def _connect_shapes(self) -> None:
        """Let the page Inspection use the feature Draw to compare versions and to merge states."""
        self.inspection.part.when_made(self._introduce_inspection)
        self.draw.shapes.run_wanted.connect(self.inspection.show_run)

    def _introduce_inspection(self, panel: InspectionPanel) -> None:
        page, comparing, shapes = panel.equivalence, self.draw.comparing, self.draw.shapes
        page.choices = (
            comparing.choose_file, comparing.choose_saved, comparing.choose_revision
        )  # fmt: skip
        page.has_file = lambda: comparing.can_use_saved
        page.play_wanted.connect(comparing.play)
        page.merge_wanted.connect(shapes.merge)

    def _start_at(self, states: tuple[str, ...]) -> None:
        self._shell.set_mode("run")
        self.run.pane.start_at(states)

    def _run_and_levels(self) -> tuple[RunSession, NextLevels]:
        return self.run.pane.run, self.run.pane.levels

    def _introduce(self, pane: RunPane) -> None:
        """Connect the parts of a run with each other, after they were made."""
        supervise, people = self.supervise.part(), self.people.part()
        self.tour.follow(pane.run)
        supervise.check.table.chosen.connect(self.monitor.show_fact)
        pane.policy = lambda: self.approval.policy
        pane.monitor_wanted.connect(self.monitor.toggle)
        pane.facts.chosen.connect(self.monitor.show_fact)
        pane.transport.world.activated.connect(lambda *_: self._inspect_in_world(pane))
        supervise.begin_wanted.connect(pane.play)
        pane.reset_wanted.connect(lambda: supervise.ask_for("reset"))
        people.take_places(supervise.task_slot, supervise.add_levels)
        people.hear(supervise)
        supervise.low_changed.connect(people.card.set_low)
        supervise.room_changed.connect(people.card.set_room)
        pane.moved.connect(self.draw.outline.set_run)
        pane.moved.connect(self._light_source)
        pane.run_exists.connect(self.run_exists)
        pane.said.connect(self.said)
        pane.said.connect(self._tell_phase)
        pane.named.connect(self.named)

    def _inspect_in_world(self, pane: RunPane) -> None:
        """Check also what is missing in the world that a person has chosen."""
        self._inspector.look_in(pane.next.world, pane.next.loaded, pane.next.robot)

    def _introduce_replay(self, verbs: ReplayVerbs) -> None:
        verbs.pane.said.connect(self.said)
        verbs.replay.opened.connect(lambda *_: self.named.emit())

    def words(self, mode: str) -> Words:
        """The texts of the status line: about the replay in its mode, else about the run."""
        if mode == "replay":
            return self.replay.verbs.pane.words
        if mode == "review":
            return self.review.words
        pane = self.run.part.made
        return pane.words if pane is not None else ((), ())

    def other(self, mode: str) -> str:
        """The file that a mode shows instead of the drawing; empty if it shows the drawing."""
        if mode in ("run", "supervise"):
            return self.run.pane.other
        return self.replay.file if mode == "replay" else ""

    def tell_caret(self) -> None:
        """Emit ``caret_moved`` again, if the source has the focus."""
        self.draw.source.tell_caret()

    def below(self, top: QWidget) -> QWidget:
        """The widget ``top`` with the bar below it that asks about a changed file."""
        return self.draw.safety.below(top)

    def open_palette(self, corner: QPoint) -> None:
        """Open the command palette below a point of the screen."""
        self.draw.palette.open(corner)

    def mode_shown(self) -> None:
        """Tell the run that another mode is shown, in which a run may begin."""
        self.draw.mode_shown()
        self.run.mode_shown()
        self.tour.look()

    def keep_unsaved(self) -> bool:
        """Write the journal now; returns whether there is unsaved work."""
        return self.draw.safety.journal.flush()

    def leave_behind(self) -> bool:
        """Keep unsaved work for the next start; returns whether there is any."""
        return self.draw.safety.journal.leave_behind()

    def may_leave(self, ask: Callable[[str], bool]) -> bool:
        """Whether the window may close; ``ask`` asks the person about a run that has not ended."""
        return self.run.may_leave(ask)

    @property
    def runs(self) -> bool:
        """Whether something moves in the run of this window."""
        return self.run.moves

    def stop_run(self) -> None:
        """Stop the run under control, and end the workers of the campaign."""
        self.run.stop_run()
        self.campaign.stop_runs()

    def stop(self) -> None:
        """End all work, because the window closes. The run ends first."""
        self.end_run()
        for feature in (
            self.replay, self.export, self.exchange, self.approval, self.review, self.merge,
            self.rules, self.planning, self.physics, self.design, self.campaign,
            self.inspection, self.draw, self.start,
        ):  # fmt: skip
            feature.stop()

    def end_run(self) -> None:
        """Stop the run, release it, and close the monitor."""
        self.monitor.stop()
        self.run.stop()

    def _light_source(self, active: Mapping[str, str], _: str) -> None:
        """Highlight the active states in the source."""
        there = active if self.run.pane.run.exists else {}
        self.draw.source.set_active(Address(sb, state) for sb, state in there.items())

    def _tell_phase(self) -> None:
        run, other = self.run.pane.run, self.run.pane.other
        self.phase_shown.emit(*phase_words(run.phase, run.over), run.sentence, other)
