"""Supervise with the keyboard alone, and the record of it."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.events import (
    Commanded,
    GivenBack,
    OperationPruned,
    OperationStarted,
    RunReset,
    RunStopped,
    TakenOver,
)
from smsl_studio.studio.running import operation_time
from smsl_studio.studio.running.persons import Person
from tests.stories.at_supervise import AtSupervise
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
REGISTRATION = SAMPLES / "registration-digitization.json"
HANOI = SAMPLES / "hanoi-corrected.json"


def test_a_whole_run_with_the_keyboard_alone(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    assert at.phase == "No run"
    assert "F5 starts one" in at.pane.notice.words
    at.start_paused()
    at.until_in("State_caa")
    _choose_veto_and_prune(at)
    _take_over_and_give_back(at)
    _stop_reset_and_end(at)
    done = [word for word, refused in at.commanded() if not refused]
    assert done == ["step", "ask", "veto", "prune", "take_over", "give_back", "give_back",
                    "accept", "stop", "reset", "stop", "end"]  # fmt: skip
    kinds = {type(event) for event in at.events}
    assert kinds >= {TakenOver, GivenBack, RunStopped, RunReset}


def _choose_veto_and_prune(at: AtSupervise) -> None:
    """Nothing moves before Enter; letters that are typed into a reason are no commands."""
    at.press(at.number("Op_2b"))
    assert at.asked.startswith("Carry out Op_2b now? It leads to State_cba.")
    at.press(Key.Key_Escape)
    assert at.asked == ""
    at.press(at.number("Op_2b"), Key.Key_Return)
    at.until_in("State_cba")
    at.until_phase("Paused")
    at.press(Key.Key_V)
    assert at.asked.startswith("Veto ")
    vetoed = at.pane.subject
    assert vetoed is not None
    at.press(Key.Key_Return)
    at.until_stands(vetoed.operation, "vetoed")
    at.press(at.number("Op_1a"), Key.Key_P, Key.Key_Return)
    assert "A reason is needed" in at.asked
    at.person.type("tip at p")
    assert at.pane.step_in.asking.reason.text() == "tip at p"
    at.press(Key.Key_Return)
    at.until_stands("Op_1a", "pruned")
    (pruned,) = (event for event in at.events if isinstance(event, OperationPruned))
    assert pruned.reason == "tip at p"


def _take_over_and_give_back(at: AtSupervise) -> None:
    """The state that was located is taken only when it is accepted."""
    at.press(Key.Key_T, Key.Key_Return)
    at.until_phase("Taken over")
    card = at.pane.board.cards[0]
    card.setFocus()
    at.press(Key.Key_T, Key.Key_Return)
    at.person.qtbot.waitUntil(lambda: at.asked.startswith("Located: SB1 in State_cba."))
    at.press(Key.Key_Escape)
    at.pane.refresh()
    assert at.asked == ""
    assert card.hasFocus(), "where it was before the question"
    assert not any(isinstance(event, GivenBack) for event in at.events)
    at.press(Key.Key_T, Key.Key_Return)
    at.person.qtbot.waitUntil(lambda: at.asked.startswith("Located: SB1 in State_cba."))
    asking = at.pane.step_in.asking
    (enter,) = (one for one in asking.findChildren(QLabel) if one.text() == "Enter")
    assert enter.isVisible()
    card.setFocus()
    assert not enter.isVisible(), "Enter presses the card that has the focus"
    asking.take_focus()
    at.press(Key.Key_Return)
    at.until_phase("Paused")
    assert any(isinstance(event, GivenBack) for event in at.events)


def _stop_reset_and_end(at: AtSupervise) -> None:
    """Stop asks nothing; reset and end do."""
    at.press(Key.Key_F8)
    at.until_phase("Stopped")
    at.press(Key.Key_F5)
    assert at.asked.startswith("Reset?")
    at.press(Key.Key_Escape)
    at.tab_to(at.pane.bar.reset)
    at.press(Key.Key_Return)
    assert at.asked.startswith("Reset?")
    at.press(Key.Key_Return)
    at.until_phase("Paused")
    at.press(Key.Key_F8)
    at.until_phase("Stopped")
    at.tab_to(at.pane.bar.end)
    at.press(Key.Key_Return, Key.Key_Return)
    at.person.qtbot.waitUntil(lambda: not at.run.exists)
    assert "F5 starts another run" in at.pane.notice.words


def test_that_the_full_map_was_looked_at_stands_in_the_record(sit: Sit) -> None:
    at = AtSupervise(sit(REGISTRATION))
    assert not at.pane.head.map.isEnabled()
    at.start_paused()
    assert at.pane.pages.currentWidget() is at.pane.board
    at.person.click(at.pane.head.map)
    at.person.qtbot.waitUntil(lambda: at.pane.pages.currentWidget() is at.pane.full_map)
    at.person.click(at.pane.head.map)
    at.person.qtbot.waitUntil(lambda: at.pane.pages.currentWidget() is at.pane.board)
    told = [(e.value, e.by) for e in at.events if isinstance(e, Commanded)
            and e.command == "full_map"]  # fmt: skip
    assert told == [("on", "a person"), ("off", "a person")]


def test_with_every_way_cut_the_run_holds_edge_by_edge_and_an_offer_restores(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    for operation in [card.name for card in at.pane.view.cards] if at.pane.view else []:
        at.press(at.number(operation), Key.Key_P)
        at.person.type("the tip is blunt")
        at.press(Key.Key_Return)
        at.until_stands(operation, "pruned")
    at.press(Key.Key_F5)
    at.until_phase("No route")
    reasons = at.pane.hold.details.splitlines()
    assert len(reasons) >= 3
    assert all(reason.startswith("SB1/State_caa/Op_") for reason in reasons[:3])
    assert "the tip is blunt" in reasons[0]
    offer = next(b for b in at.pane.hold.buttons() if b.accessibleName().startswith("Restore"))
    at.tab_to(offer)
    at.press(Key.Key_Return)
    assert at.asked.startswith("Restore Op_")
    at.press(Key.Key_Return)
    at.person.qtbot.waitUntil(
        lambda: [word for word, _ in at.commanded()][-1] == "restore", timeout=30_000
    )


def test_what_a_run_refuses_is_said_in_place(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    at.run.accept()
    at.person.qtbot.waitUntil(lambda: "Nobody has taken over" in at.pane.step_in.refusal)
    at.press(Key.Key_Escape)
    assert at.pane.step_in.refusal == ""


def test_a_veto_of_what_moves_comes_too_late_and_others_wait_their_turn(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start("hanoi")
    at.person.qtbot.waitUntil(lambda: at.standing("Op_1c") == "running", timeout=60_000)
    at.press(Key.Key_V)
    assert "a veto comes too late" in at.asked
    at.press(Key.Key_Return)
    at.press(Key.Key_Escape, at.number("Op_1b"))
    assert "One operation at a time, Op_1c is under way." in at.asked
    at.press(Key.Key_Return)
    assert at.commanded() == []
    at.press(Key.Key_Escape, Key.Key_P)
    at.person.type("it slips")
    at.press(Key.Key_Return)
    at.until_stands("Op_1c", "pruned")


def test_commands_carry_the_name_of_who_works_here(sit: Sit) -> None:
    person = sit(HANOI)
    person.windows.persons.put(Person("L. Brandt", "surgeon"))
    at = AtSupervise(person)
    at.start_paused()
    at.press(Key.Key_T, Key.Key_Return)
    at.until_phase("Taken over")
    assert at.pane.bar.person == "L. Brandt"
    told = {event.by for event in at.events if isinstance(event, Commanded | TakenOver)}
    assert told == {"L. Brandt"}


def test_arrows_lead_from_card_to_card_and_every_one_has_a_name(sit: Sit) -> None:
    at = AtSupervise(sit(REGISTRATION))
    at.start_paused()
    cards = at.pane.board.cards
    cards[0].setFocus()
    at.press(Key.Key_Down, Key.Key_Down)
    assert cards[2].hasFocus()
    at.press(Key.Key_Up)
    assert cards[1].hasFocus()
    at.press(Key.Key_Return)
    assert cards[1].card.name in at.asked
    for card in cards:
        assert card.accessibleName().startswith(f"{card.card.number}, {card.card.name}, ")
    assert all(spot.accessibleName() for spot in at.pane.board.spots)
    started = len([event for event in at.events if isinstance(event, OperationStarted)])
    at.press(Key.Key_Escape)
    assert len([e for e in at.events if isinstance(e, OperationStarted)]) == started


def test_p_on_what_is_pruned_offers_to_restore_it_and_never_asks_again(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    at.press(at.number("Op_2b"), Key.Key_P)
    at.person.type("x")
    at.press(Key.Key_Return)
    at.until_stands("Op_2b", "pruned")
    at.press(at.number("Op_2b"), Key.Key_P)
    assert at.asked.startswith("Restore Op_2b? ")
    assert "x" in at.asked.removeprefix("Restore Op_2b? ")
    assert not at.pane.step_in.asking.reason.isVisible()
    assert at.pane.step_in.prune.text() == "Restore…"
    at.press(Key.Key_V)
    assert at.asked.startswith("Restore Op_2b? ")
    at.press(Key.Key_Return)
    at.person.until(lambda: at.standing("Op_2b") in ("possible", "next"))
    assert [word for word, _ in at.commanded()] == ["step", "prune", "restore"]


def test_a_prune_says_when_its_operation_has_ended_while_the_reason_is_typed(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", 3.0)
    at = AtSupervise(sit(HANOI))
    at.start("table")
    at.person.until(lambda: at.run.status is not None and at.run.status.running is not None)
    at.press(Key.Key_P)
    at.person.type("tip")
    status = at.run.status
    assert status is not None
    running = status.running
    assert running is not None
    assert f"Prune {running.operation}? It is stopped and held." in at.asked
    at.person.until(lambda: at.run.status is not None and at.run.status.running != running)
    at.person.until(lambda: "It has ended, so nothing is stopped now." in at.asked)
    assert "stopped and held" not in at.asked
    assert at.pane.step_in.asking.reason.text() == "tip"
    at.press(Key.Key_Return)
    at.person.until(lambda: bool(at.pane.step_in.told))
    assert at.pane.step_in.told == f"Pruned: {running}. Restore lets it be used again."


def test_a_second_press_of_step_leaves_no_refusal_behind(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start("table", Key.Key_F10)
    at.press(Key.Key_F10)
    at.until_phase("Paused")
    assert at.pane.step_in.refusal == ""


def test_a_stop_takes_away_a_question_that_a_stopped_run_refuses(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    at.press(at.number("Op_2b"), Key.Key_V)
    assert at.asked.startswith("Veto Op_2b once?")
    at.press(Key.Key_F8)
    at.until_phase("Stopped")
    at.person.until(lambda: at.asked == "")
    assert at.pane.step_in.refusal.startswith("The run is stopped, reset it first. The question")
    at.press(Key.Key_Return)
    assert "veto" not in [word for word, _ in at.commanded()]


def test_a_stopped_run_takes_a_prune_and_a_restore_and_its_button_says_so(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    at.press(at.number("Op_2b"), Key.Key_P)
    at.press(Key.Key_F8)
    at.until_phase("Stopped")
    assert at.pane.step_in.prune.isEnabled()
    assert not at.pane.step_in.veto.isEnabled()
    at.person.type("blunt")
    at.press(Key.Key_Return)
    at.until_stands("Op_2b", "pruned")
    at.press(at.number("Op_2b"), Key.Key_P)
    assert at.asked.startswith("Restore Op_2b? ")
    assert at.pane.step_in.prune.isEnabled()
    at.press(Key.Key_Return)
    at.person.until(lambda: "restore" in [word for word, _ in at.commanded()])


def test_why_a_command_was_refused_goes_with_the_next_one_that_is_not(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.press(Key.Key_V)
    assert at.pane.step_in.refusal == "No run is there to step into."
    at.start_paused()
    assert at.pane.step_in.refusal == ""
    at.press(Key.Key_T, Key.Key_Return)
    at.until_phase("Taken over")
    at.press(Key.Key_F5)
    at.person.until(lambda: "is locked out" in at.pane.step_in.refusal)
    at.press(Key.Key_T, Key.Key_Return)
    at.person.until(lambda: at.asked.startswith("Located"))
    at.press(Key.Key_Return)
    at.until_phase("Paused")
    assert at.pane.step_in.refusal == ""


def test_v_on_what_is_vetoed_already_offers_to_restore_it(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    at.press(at.number("Op_2b"), Key.Key_V, Key.Key_Return)
    at.until_stands("Op_2b", "vetoed")
    at.press(at.number("Op_2b"), Key.Key_V)
    assert at.asked.startswith("Restore Op_2b? ")
    assert at.pane.step_in.prune.text() == "Prune…"
    at.press(Key.Key_Return)
    at.person.until(lambda: at.standing("Op_2b") in ("possible", "next"))


def test_every_command_of_the_menu_that_a_pause_allows_asks_with_the_words_of_its_row(
    sit: Sit,
) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    rows = [row for row in COMMANDS.values() if row.tip and row.word != "full_map"]
    rows = [row for row in rows if "paused" not in {*row.refused, *row.useless}]
    assert {"veto", "prune", "take_over"} <= {row.word for row in rows}
    for row in rows:
        assert at.person.window.actions_table[row.word].isEnabled(), row.word
        at.person.window.actions_table[row.word].trigger()
        assert row.consequence in at.asked, row.word
        at.press(Key.Key_Escape)
        assert at.asked == "", row.word
    assert [word for word, _ in at.commanded()] == ["step"]
