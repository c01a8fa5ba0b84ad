"""The page Campaign as a feature: its rows in the menus, its file, and what its buttons do."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt

from smsl_studio.errors import SaveError, StudioError
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.file_dialogs import ask_to_save
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.front.campaign_tally import CampaignCell
    from smsl_studio.front.recordings import Recording
    from smsl_studio.studio.features.campaign.bar import CampaignBar
    from smsl_studio.studio.features.campaign.choice import CampaignChoice
    from smsl_studio.studio.features.campaign.page import CampaignPage
    from smsl_studio.studio.features.campaign.run_again import RunAgain
    from smsl_studio.studio.features.campaign.work import CampaignWork

NAME = "Campaign"
KINDS = "Report (*.html);;Results (*.json);;Results (*.parquet)"
AT = 40.0
"""How far a note stands right of its state, and half of how far below (pixels)."""


class CampaignFeature(Feature):
    """Offers the page. Its parts are made when it is first shown."""

    def __init__(self, parts: WindowParts, shell: Shell) -> None:
        self._parts, self._shell, self._tokens = parts, shell, parts.tokens
        self._loaded: Loaded | None = None
        self.show_page: Callable[[str], None] = lambda name: None
        """Shows a page of Run by its name."""
        self.replay: Callable[[Path], None] = lambda path: None
        """Shows a recorded run."""
        self.work: CampaignWork | None = None
        self.again: RunAgain | None = None
        self.part = LatePart(self._make)
        self.row = LatePart(self._make_row)
        """What stands in the mode bar while the page is shown."""

    @cached_property
    def choice(self) -> CampaignChoice:
        """What was chosen last; it stays while the window is open."""
        from smsl_studio.studio.features.campaign.choice import CampaignChoice

        return CampaignChoice(world="", faults=("all",))

    @property
    def page(self) -> CampaignPage:
        """The page."""
        return self.part()

    def _make(self) -> CampaignPage:
        from smsl_studio.studio.features.campaign.page import CampaignPage
        from smsl_studio.studio.features.campaign.run_again import RunAgain
        from smsl_studio.studio.features.campaign.work import CampaignWork

        session = self._parts.session
        self.work = CampaignWork(self._parts.window)
        folder = self._parts.settings.folder / "campaigns"
        self.again = RunAgain(self.work, folder, self._parts.window)
        page = CampaignPage(self.work, self._tokens)
        self.work.refused.connect(self._parts.toast.refuse)
        page.new_wanted.connect(self.new)
        page.rates_wanted.connect(self.write_rates)
        page.replay_wanted.connect(self._replay)
        page.story_wanted.connect(self._tell_story)
        page.finding_wanted.connect(self.open_finding)
        session.blueprint_changed.connect(lambda *_: page.show_drawing(session.blueprint))
        page.show_drawing(session.blueprint)
        return page

    def _make_row(self) -> CampaignBar:
        from smsl_studio.studio.features.campaign.bar import CampaignBar

        self.part()
        assert self.work is not None
        row = CampaignBar(self.work, self._tokens)
        row.new_wanted.connect(self.new)
        row.export_wanted.connect(self.export)
        row.turn_wanted.connect(self._turn)
        row.stop_wanted.connect(self._shell.program.stop_every_run)
        return row

    def _turn(self) -> None:
        if self.work is not None and self.work.moves:
            self.pause()
        else:
            self.play()

    def actions(self) -> tuple[Action, ...]:
        """The rows of the menu Run."""
        return (
            Action("campaign_page", "Campaign", self.show, "Run", "", (), self._can_show, section=3,
                   tip="Many runs with seeds and faults: how often the goal is reached",
                   also="fault atlas sweep statistics"),
            Action("new_campaign", "New campaign…", self.new, "", "", (), self._can_show,
                   tip="Choose world, faults, seeds and workers"),
        )  # fmt: skip

    def _can_show(self) -> bool:
        return self._shell.mode != "start"

    def show(self) -> None:
        """Show the page."""
        self.show_page(NAME)

    def new(self) -> None:
        """Ask for a campaign and begin it."""
        from smsl_studio.studio.features.campaign.choice import CampaignOffer
        from smsl_studio.studio.features.campaign.dialog import CampaignDialog

        self.show()
        offer = CampaignOffer(self._parts.session.blueprint, self._loaded)
        dialog = CampaignDialog(self.choice, offer, self._parts.window)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)

        def take() -> None:
            """Begin what was chosen."""
            self.choice = dialog.choice
            self._begin()

        dialog.accepted.connect(take)
        dialog.open()

    def _begin(self) -> None:
        from smsl_studio.studio.features.campaign.run_again import forget_old

        folder = self._parts.settings.folder / "campaigns"
        try:
            request = self.choice.request(self._parts.session.blueprint, folder)
            forget_old(folder)
        except OSError as error:
            words = f"{folder} cannot be made: {error.strerror or error}"
            self._parts.toast.refuse(SaveError(words, advice="Is the disk full?"))
            return
        self.page.show_drawing(self._parts.session.blueprint)
        assert self.work is not None
        self.work.start(request)

    # The keys of a run, while the page is shown.

    def play(self) -> None:
        """Go on with a campaign that is paused; without one, ask for one."""
        if self.work is not None and self.work.phase == "paused" and not self.page.is_another:
            self.work.resume()
        elif self.work is None or not self.work.moves:
            self.new()

    def pause(self) -> None:
        """Let the current run end, and keep what is done."""
        if self.work is not None:
            self.work.pause()

    def stop_runs(self) -> None:
        """End all workers now. What is done is kept."""
        if self.work is not None:
            self.work.stop()

    def write_rates(self) -> None:
        """Show the measured costs and risks beside the declared ones, and write what is chosen."""
        from smsl_studio.front.campaign_rates import proposals, with_rates
        from smsl_studio.studio.features.campaign.rates_dialog import RatesDialog

        assert self.work is not None
        session = self._parts.session
        dialog = RatesDialog(proposals(session.blueprint, self.work.tally), self._parts.window)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)

        def write() -> None:
            """Write what was chosen, as one step of the history."""
            chosen = dialog.chosen
            done = session.edit(
                "Costs and risks of the campaign", lambda before: with_rates(before, chosen)
            )
            if done:
                count = counted(len(chosen), "operation")
                words = f"Wrote costs and risks of {count}."
                self._parts.toast.offer(words, "Undo", session.history.undo)

        dialog.accepted.connect(write)
        dialog.open()

    def open_finding(self, cell: CampaignCell) -> None:
        """Write a note of what ended otherwise than foreseen, as one step of the history, and show
        it."""
        from datetime import date

        from smsl_studio.blueprint.address import Address
        from smsl_studio.blueprint.editing.drawn import free_keys, put_notes
        from smsl_studio.front.campaign_foreseen import finding_of

        assert self.work is not None
        assert self.work.request is not None
        session, edge = self._parts.session, Address(*Address.split(cell.edge))
        if edge.state not in getattr(session.blueprint.branches.get(edge.branch), "table", {}):
            self._parts.toast.say("The drawing has no such state any more.")
            return
        words = {
            "text": finding_of(cell, self.work.request.world), "state": edge.state,
            "date": date.today().isoformat(), "at": (AT, 2 * AT),
        }  # fmt: skip
        key = next(free_keys(session.blueprint[edge.branch].drawn.notes))
        done = session.edit(
            "Note of the campaign", lambda before: put_notes(before, edge.branch, {key: words})
        )
        if done:
            self._shell.set_mode("draw")
            session.select((edge,))
            self._parts.toast.offer("Wrote a note of the campaign.", "Undo", session.history.undo)

    def export(self) -> None:
        """Save a report or the results."""
        from smsl_studio.front.campaign_page import campaign_page
        from smsl_studio.front.campaign_parquet import as_parquet
        from smsl_studio.smsl.files import save_document

        work = self.work
        assert work is not None
        assert work.request is not None
        stem = Path(work.request.blueprint.file).stem
        path = self._parts.files.path
        folder = path.parent if path is not None else Path.home()
        suggested = str(folder / f"{stem}-campaign.html")
        name, kind = ask_to_save(self._parts.window, "Export the campaign", suggested, KINDS)
        if not name:
            return
        done = work.tally.result(work.digest, work.left_out)
        read = [one.file for one in work.request.blueprint.documents]
        try:
            if "parquet" in kind or name.endswith(".parquet"):
                raw = as_parquet(done)
            elif "json" in kind or name.endswith(".json"):
                raw = f"{json.dumps(done.as_json(), indent=1)}\n".encode("ascii")
            else:
                raw = campaign_page(work.request, done).encode("utf-8")
            save_document(raw, Path(name), made_of=read)
        except StudioError as error:
            self._parts.toast.refuse(error)
            return
        self._parts.toast.say(f"Saved {Path(name).name}.")

    def _replay(self, cell: CampaignCell, seed: int) -> None:
        """Carry a run of a cell out again with a log, and show it."""
        from smsl_studio.studio.features.campaign.run_again import OTHER

        side, again = self.page.side, self.again
        assert again is not None
        side.say(f"Carrying out the run of seed {seed} again…")

        def show(log: Path, _: Recording, other: bool) -> None:
            """Show the log, and say so if the run was another one than before."""
            side.say("")
            self.replay(log)
            if other:
                self._parts.toast.tell(OTHER, "Show the campaign", self.show, "W")

        def refuse(error: StudioError) -> None:
            """Say why there is no run to show."""
            side.say("")
            self._parts.toast.refuse(error)

        again.look(cell, seed, show, refuse)

    def _tell_story(self, cell: CampaignCell, seed: int) -> None:
        """Show the events of a run beside its cell."""
        from smsl_studio.studio.features.campaign.run_again import OTHER

        side, again = self.page.side, self.again
        assert again is not None

        def show(_: Path, recording: Recording, other: bool) -> None:
            """Show the run, or that it was another one than before."""
            if other:
                side.story.show_words(OTHER)
            else:
                side.show_story(recording, seed)

        if not side.told.text():  # a replay goes before
            again.look(cell, seed, show, lambda error: side.story.show_words(str(error)))

    # What the shell needs.

    def set_plugins(self, loaded: Loaded, known: bool) -> None:
        """Receive what the installed plugins offer."""
        self._loaded = loaded if known else None

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)
        if self.row.made is not None:
            self.row.made.set_tokens(tokens)

    def show_run(self, exists: bool) -> None:
        """Take note whether there is a run, which Stop stops too."""
        if self.row.made is not None:
            self.row.made.show_run(exists)

    def stop(self) -> None:
        """End all work, because the window closes. What is done is kept."""
        if self.work is not None:
            self.work.shut()
        if self.again is not None:
            self.again.stop()
