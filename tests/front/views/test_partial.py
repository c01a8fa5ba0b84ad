"""The partial view of one State Branch, computed from a status alone."""

from __future__ import annotations

from smsl_studio.blueprint.check import Term
from smsl_studio.dispatch.people.task import Task
from smsl_studio.front.views.partial import outside_facts, partial_view, shown_branch
from tests.front.views.statuses import at, possible, sample, status, written

REGISTRATION = "REGISTRATION"
SAMPLE = sample("registration-digitization.json")
HERE = {"REGISTRATION": "State110", "DIGITIZATION": "State1"}
WITH_NOTES = written("""{"A": {"HEADER": {"NUM_FACTS": 2, "INITIAL": "S00", "ACTIVATING": "S11"},
  "_states": {"S00": {"title": "Nothing yet"}},
  "_operations": {
    "Rise": {"risk": "high", "cost": 2.5, "actor": "human", "confirm": ["surgeon", "nurse"]},
    "Turn": {"confirm": ["surgeon"]}},
  "S00": {"Rise": "S10", "Stay": "S00", "Turn": "S11", "Lift": "S10"},
  "S10": {"Turn": "S11"}, "S11": {"Fall": "S00"}},
 "B": {"HEADER": {}, "_facts": {"0": {"name": "Clamp fixed"}}, "S0": {"Fix": "S1"}, "S1": {}}}""")


def test_operations_of_one_target_stand_together_and_those_that_stay_come_last() -> None:
    view = partial_view(WITH_NOTES, status({"A": "S00", "B": "S0"}), "A")
    assert view is not None
    assert [card.name for card in view.cards] == ["Rise", "Lift", "Turn", "Stay"]
    assert [card.number for card in view.cards] == [1, 2, 3, 4]
    assert view.neighbours == ("S10", "S11")
    assert view.cards[-1].stays


def test_their_order_does_not_follow_the_route() -> None:
    """A key must not mean something else because something was pruned meanwhile."""
    plain = partial_view(SAMPLE, status(HERE), REGISTRATION)
    addresses = [card.address for card in plain.cards] if plain else []
    routed = status(
        HERE,
        route=(addresses[-2],),
        possible=(possible(str(addresses[0]), "State100", permitted=False, pruned=True),),
    )
    again = partial_view(SAMPLE, routed, REGISTRATION)
    assert again is not None
    assert [card.address for card in again.cards] == addresses


def test_a_card_has_risk_cost_who_acts_and_what_it_takes() -> None:
    found = status({"A": "S00", "B": "S0"}, possible=(possible("A/S00/Rise", "S10", cost=2.5),))
    view = partial_view(WITH_NOTES, found, "A")
    assert view is not None
    rise, lift, turn, _ = view.cards
    assert (rise.risk, rise.cost, rise.actor, rise.needs) == ("high", "2.5", "human", "2 people")
    assert (lift.risk, lift.cost, lift.actor, lift.needs) == ("", "1.0", "robot", "")
    assert turn.needs == "Surgeon"
    assert view.title == "Nothing yet"


def test_marks_of_sub_sbs() -> None:
    view = partial_view(SAMPLE, status(HERE), REGISTRATION)
    assert view is not None
    marks = {card.name: card.mark for card in view.cards}
    assert marks["ClearDigitization"] == "fall"
    assert marks["ClearLandmarks"] == "mixed"
    assert marks["Registered"] == ""


def test_how_an_operation_stands() -> None:
    unknown = Term(("B", 0), "1", None, None, "no reading for 1.2 s")
    edges = {
        "Rise": possible("A/S00/Rise", "S10", on_route=True),
        "Lift": possible("A/S00/Lift", "S10", permitted=False, reasons=("no",), needs=(unknown,)),
        "Turn": possible("A/S00/Turn", "S11", permitted=False, pruned=True, reasons=("blunt",)),
        "Stay": possible("A/S00/Stay", "S00", vetoed=True),
    }
    here = {"A": "S00", "B": "S0"}
    found = status(here, possible=tuple(edges.values()), route=(at("A/S00/Rise"),))
    view = partial_view(WITH_NOTES, found, "A")
    assert view is not None
    standing = {card.name: card.standing for card in view.cards}
    assert standing == {"Rise": "next", "Lift": "unknown", "Turn": "pruned", "Stay": "vetoed"}
    assert view.ahead == "S10"
    lift = view.cards[1]
    assert (lift.needs, lift.unmet) == ("Clamp fixed?", "unknown")
    (outside,) = outside_facts(WITH_NOTES, found, view)
    assert (outside.name, outside.words) == ("Clamp fixed", "unknown, no reading for 1.2 s")
    assert outside.blocks == ("Lift",)


def test_while_one_operation_moves_that_is_why_no_other_may() -> None:
    moving = at("A/S00/Rise")
    edges = (possible("A/S00/Rise", "S10"), possible("A/S00/Lift", "S10", permitted=False,
             reasons=("A/S00 does not check true",)))  # fmt: skip
    here = {"A": "S00", "B": "S0"}
    view = partial_view(WITH_NOTES, status(here, phase="running", running=moving, possible=edges),
                        "A")  # fmt: skip
    assert view is not None
    assert view.cards[0].standing == "running"
    assert view.cards[1].reasons == ("one operation at a time, Rise is under way",)
    paused = partial_view(WITH_NOTES, status(here, running=moving, possible=edges), "A")
    assert paused is not None
    assert paused.cards[0].standing == "paused"


def test_a_fact_that_reads_otherwise_is_said_with_both_values() -> None:
    false = Term(("B", 0), "1", "0", False)
    edge = possible("A/S00/Rise", "S10", permitted=False, reasons=("no",), needs=(false,))
    view = partial_view(WITH_NOTES, status({"A": "S00", "B": "S0"}, possible=(edge,)), "A")
    assert view is not None
    rise = view.cards[0]
    assert (rise.needs, rise.unmet) == ("Clamp fixed: 0, not 1", "missing")
    assert rise.standing == "refused"


def test_where_one_came_from_and_for_how_long_one_is_here() -> None:
    via = at("REGISTRATION/State100/LandmarksDigitized")
    found = status(HERE, previous={REGISTRATION: via}, since={REGISTRATION: 19.0})
    view = partial_view(SAMPLE, found, REGISTRATION)
    assert view is not None
    assert (view.via, view.via_mark, view.seconds) == (via, "rise", 41.0)


def test_the_sb_that_is_shown() -> None:
    asked = Task("t", "fact", "DIGITIZATION/0", "?", "", (), ("",), 0.0, 60.0, 120.0)
    running = at("DIGITIZATION/State1/ReinitState")
    assert shown_branch(status(HERE)) == REGISTRATION
    assert shown_branch(status(HERE, running=running)) == "DIGITIZATION"
    assert shown_branch(status(HERE, tasks=(asked,))) == "DIGITIZATION"
    assert shown_branch(status(HERE), "DIGITIZATION") == "DIGITIZATION"
    assert shown_branch(status(HERE, goals=(at("REGISTRATION/State111"),)), "", "DIGITIZATION") == (
        "DIGITIZATION"
    )
    assert partial_view(SAMPLE, status({}), shown_branch(status({}))) is None


def test_what_waits_for_people() -> None:
    operation = "REGISTRATION/State110/Registered"
    task = Task("t", "confirm", operation, "?", "", (), ("a", "b"), 0.0, 60.0, 120.0)
    view = partial_view(SAMPLE, status(HERE, phase="waiting", tasks=(task,)), REGISTRATION)
    assert view is not None
    waits = [card.name for card in view.cards if card.standing == "waits"]
    assert waits == ["Registered"]


def test_an_operation_that_only_moves_a_sub_sb_shows_no_cost() -> None:
    view = partial_view(SAMPLE, status(HERE), REGISTRATION)
    assert view is not None
    branch = SAMPLE[REGISTRATION]
    for card in view.cards:
        before, after = branch.facts("State110"), branch.facts(card.target)
        changed = [digit for digit in range(3) if before[digit] != after[digit]]
        assert (card.cost == "") is (changed in ([digit] for digit in branch.subs)), card.name
    assert len({card.cost for card in view.cards}) > 1
