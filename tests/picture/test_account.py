"""The account of a run is complete and in order, and holds nothing that a browser would execute."""

from __future__ import annotations

import io
from collections.abc import Mapping
from html.parser import HTMLParser
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.picture import account as page
from smsl_studio.picture.account_words import told
from smsl_studio.runlog.causes import Causes
from smsl_studio.runlog.events import (
    Commanded,
    Committed,
    EdgeSwept,
    Event,
    FactChanged,
    Held,
    Mismatch,
    OperationEnded,
    OperationPruned,
    OperationStarted,
    Paused,
    RoutePlanned,
    RunFinished,
    StateChecked,
    SweepFinished,
    TaskAnswered,
    TaskClosed,
    TaskOpened,
)
from smsl_studio.runlog.grammar.log_reader import LoggedRun, LogHead, Record, read_records
from tests.counts import share_of
from tests.runlog.any_event import events
from tests.runlog.logs import EVENTS, write_log

SHUT = {"meta"}
ALLOWED = {
    *("html", "head", "meta", "title", "style", "body", "main", "section", "footer"),
    *("h1", "h2", "h3", "p", "strong", "code", "dl", "dt", "dd", "ol", "li"),
    *("table", "thead", "tbody", "tr", "th", "td"),
}


def account_of(run: LoggedRun) -> str:
    return page.account(run, COMMANDS)


class Page(HTMLParser):
    """What a browser sees: text by the tag it stands in, and every row of its tables. The last
    table has the events."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.texts: list[tuple[str, str]] = []
        self.tables: list[list[list[str]]] = []
        self.odd: list[object] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in ALLOWED:
            self.odd.append(tag)
        if tag not in SHUT:
            self.open.append(tag)
            self.odd += [(tag, name) for name, _ in attrs if name not in ("class", "lang")]
        if tag == "table":
            self.tables.append([])
        if tag == "tr":
            self.rows.append([])
        if tag == "td":
            self.rows[-1].append("")

    @property
    def rows(self) -> list[list[str]]:
        return self.tables[-1]

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and data.strip():
            self.texts.append((self.open[-1], data))
            if self.open[-1] == "td":
                self.rows[-1][-1] += data

    def under(self, tag: str) -> list[str]:
        return [text for where, text in self.texts if where == tag]


def logged(*given: Event, header: Mapping[str, Any] | None = None) -> LoggedRun:
    records = tuple(Record(n, one.line(), one) for n, one in enumerate(given, 2))
    return LoggedRun(header or {}, records, LogHead(len(records), "0" * 64), None)


@pytest.fixture
def run(tmp_path_factory: pytest.TempPathFactory) -> LoggedRun:
    raw = write_log(tmp_path_factory.mktemp("log") / "log")
    return read_records(io.BytesIO(raw), "log", COMMANDS)


def test_everything_is_told_in_order(run: LoggedRun) -> None:
    seen = Page(account_of(run))
    assert seen.odd == []
    rows = seen.rows[1:]
    assert [(row[0], row[1]) for row in rows] == [
        ("0.000", "believed"),
        ("0.000", "sensed"),
        ("0.000", "sensed"),
        ("0.000", "decided"),
        ("0.000", "done"),
        ("0.050", "sensed"),
        ("0.100", "sensed"),
        ("0.100", "done"),
        ("0.100", "sensed"),
        ("0.100", "believed"),
        ("0.100", "done"),
        ("0.200", "done"),
        ("0.200", "decided"),
        ("0.200", "sensed"),
        ("0.200", "believed"),
        ("0.250", "believed"),
        ("0.250", "decided"),
    ]
    assert rows[5][2:] == ["Fact 1 of SB/é is unknown (stale)", "sensors of table"]
    assert rows[4][3] == "library function"
    agrees = "The scene agrees with SB/é/State_2"
    assert rows[13][2] == f"Sensed facts and beliefs differ: a; b. {agrees}"
    assert seen.under("li") == ["SB~1é/State_0/Op", "SB~1é/State_1/Op"]
    assert seen.under("strong") == ["The goal was reached.", "Verified"]
    assert run.head is not None
    assert run.head.hash in seen.under("code")


def test_equal_logs_give_equal_pages(run: LoggedRun) -> None:
    assert account_of(run) == account_of(run)


def test_a_run_from_the_command_line_has_its_header_told() -> None:
    header = {
        "file": "C:\\cases\\knee.smsl",
        "seed": 7,
        "policy": None,
        "levels": {"SB/go": "human", "inspection": "shared"},
        "mqtt": {"broker": "lab:1883", "site": "lab", "facts": {"SB/0": ["eye", "ear"]}},
        "goals": ["SB/A", "SB/B"],
        "digests": {"file": "ff", "imported": {"sub.smsl": "ee"}},
        "versions": {"python": "3.11.7"},
    }
    seen = Page(account_of(logged(header=header)))
    assert seen.under("h1") == ["Account of a run of knee.smsl"]
    pairs = dict(zip(seen.under("dt"), seen.under("dd") + seen.under("code"), strict=False))
    assert pairs["Goals asked for"] == "SB/A, SB/B"
    assert pairs["Approval"].startswith("Uninspected")
    assert pairs["Levels set before the run"] == "SB/go: human; inspection: shared"
    heard = "broker: lab:1883; site: lab; facts: SB/0: eye, ear"
    assert pairs["Sensors elsewhere"] == heard
    assert {"ff", "ee"} <= set(seen.under("code"))
    assert "imported sub.smsl" in seen.under("dt")


SIGNERS = {"signers": [1, {"person": ["<b>"], "role": None}], "keys": {"<b>": 1}}


@pytest.mark.parametrize(
    "odd", [None, [], [[[]]], {"a": {"b": {"c": 1}}}, 1e400, True, "x", [{}], SIGNERS]
)
def test_a_header_may_say_anything(odd: object) -> None:
    keys = (
        "file",
        "seed",
        "start",
        "goals",
        "policy",
        "digests",
        "versions",
        "log",
        "names",
        "mqtt",
    )
    assert Page(account_of(logged(header=dict.fromkeys(keys, odd)))).odd == []


def test_what_has_a_name_is_told_by_it() -> None:
    given = (
        RoutePlanned(t=0.0, goal="SB/B", operations=("SB/A/go",), cost=1.0),
        OperationStarted(t=0.0, address="SB/A/go", target="B"),
        FactChanged(t=0.1, branch="SB", digit=0, value="1"),
        FactChanged(t=0.1, branch="SB", digit=1, value=None, reason="stale"),
        Committed(t=0.2, operations=("SB/A/go",), configuration={"SB": "B"}),
        Commanded(t=0.2, command="veto", by="Ann", address="SB/B/go"),
    )
    names = {
        "facts": {"SB/0": "Head fixed"},
        "states": {"SB/B": "Ready"},
        "operations": {"SB/go": "Go on", "SB/A/go": "Fix the head"},
    }
    seen = Page(account_of(logged(*given, header={"names": names})))
    assert [row[2] for row in seen.rows[1:]] == [
        'Route to SB/B "Ready", cost 1: SB/A/go "Fix the head"',
        'SB/A/go "Fix the head" to B "Ready" is carried out; no function of its own',
        "Head fixed of SB reads 1",
        "Fact 2 of SB is unknown (stale)",
        'SB/A/go "Fix the head" became true: SB/B "Ready"',
        'Vetoed SB/B/go "Go on"',
    ]
    assert seen.under("li") == ['SB/A/go "Fix the head"']


def test_what_people_said_and_did_is_told_as_theirs_and_in_words() -> None:
    """No sensor said it, and no function did it."""
    said = {"N. Kaya": "1"}
    given = (
        FactChanged(t=0.0, branch="H", digit=0, value=None, reason="nobody has answered yet"),
        TaskOpened(t=0.0, task="task-1", kind="operation", address="H/A/fix", question="Close it.",
                   options=("done", "could_not"), role="nurse", persons=1, deadline=9.0),
        TaskClosed(t=1.0, task="task-1", outcome="answered", answer="done",
                   answers={"N. Kaya": "done"}),
        OperationEnded(t=1.1, address="H/A/fix", outcome="returned", message="done by N. Kaya"),
        TaskOpened(t=1.1, task="task-2", kind="fact", address="H/0", question="Is it fixed?",
                   options=("0", "1"), role="nurse", persons=1, deadline=9.0),
        TaskClosed(t=2.0, task="task-2", outcome="answered", answer="1", answers=said),
        FactChanged(t=2.0, branch="H", digit=0, value="1"),
        FactChanged(t=3.0, branch="H", digit=0, value="0"),
    )  # fmt: skip
    names = {"facts": {"H/0": "Head fixed"}, "values": {"H/0/1": "fixed", "H/0/0": "free"}}
    seen = Page(account_of(logged(*given, header={"names": names})))
    assert seen.tables[0][1:] == [["N. Kaya", "1 done, 1 fact told", "0.9 s, at most 1.0 s", "0"]]
    rows = seen.rows[1:]
    assert [row[3] for row in rows] == [
        "nobody", "dispatcher", "N. Kaya", "N. Kaya", "dispatcher", "N. Kaya", "N. Kaya", "sensors",
    ]  # fmt: skip
    assert rows[3][2] == "H/A/fix was done by hand: done by N. Kaya"
    assert rows[4][2].endswith('Is it fixed? 0 "free" / 1 "fixed"')
    assert rows[5][2] == ('task-2 "Is it fixed?" was answered with 1 "fixed" (N. Kaya: 1 "fixed")')
    assert rows[6][2] == 'Head fixed of H reads 1 "fixed"'


def test_a_log_without_an_end_says_so(run: LoggedRun) -> None:
    seen = Page(account_of(logged(*EVENTS[:6])))
    assert "The log ends before the run did." in seen.under("strong")
    assert " Its last event is at 0.050 s." in seen.under("p")
    assert "The log ends before the run did." in Page(account_of(logged())).under("strong")


HOSTILE = "</td></table><script>alert(1)</script><img src=x onerror=y>\"'&lt;\u202e\x1b\n\udcff"


def test_names_are_only_text() -> None:
    finished = RunFinished(
        t=0.0, reason=HOSTILE, sentence=HOSTILE, operations=0, configuration={HOSTILE: HOSTILE}
    )
    mismatch = Mismatch(t=0.0, facts=(HOSTILE,), candidates=({HOSTILE: HOSTILE},))
    fact = FactChanged(t=0.0, branch="SB", digit=0, value="1")
    header = {
        "file": HOSTILE,
        "goals": [HOSTILE],
        "levels": {HOSTILE: HOSTILE},
        "digests": {HOSTILE: HOSTILE},
        "names": {"facts": {"SB/0": HOSTILE}, "states": {HOSTILE: HOSTILE}},
    }
    text = account_of(logged(fact, mismatch, finished, header=header))
    seen = Page(text)
    assert seen.odd == []
    assert len(seen.rows) == 4
    assert any("<script>alert(1)</script>" in cell for cell in seen.rows[1])
    assert not set("\u202e\x1b\udcff") & set(text)
    assert "default-src 'none'" in text


@given(st.lists(events(), max_size=6))
@settings(max_examples=share_of(40))
def test_any_events_can_be_told(given: list[Event]) -> None:
    seen = Page(account_of(logged(*given)))
    assert seen.odd == []
    assert len(seen.rows) == len(given) + 1


@given(events())
@settings(max_examples=share_of(100))
def test_every_event_of_a_run_has_words_of_its_own(event: Event) -> None:
    if not isinstance(event, EdgeSwept | SweepFinished):
        assert not told(event, COMMANDS).what.startswith(event.event.replace("_", " "))


def test_who_did_it_and_what_is_bad() -> None:
    causes = Causes(COMMANDS, {})
    events = (
        Commanded(t=1.0, command="prune", by="L. Brandt", address="a", reason="no"),
        OperationPruned(t=1.0, address="a", reason="no"),
        Commanded(t=1.0, command="pause", by="script", refused="it is paused already"),
        Paused(t=1.0),
        OperationPruned(t=2.0, address="b", reason="no"),
        TaskAnswered(t=2.0, task="task 1", by="A. Okafor", role="surgeon"),
        TaskClosed(t=2.0, task="task 1", outcome="disagreed", answers={"A": "yes", "B": "no"}),
    )
    found = [told(event, COMMANDS, "", causes.of(event)) for event in events]
    who = ["L. Brandt", "L. Brandt", "script", "dispatcher", "dispatcher", "A. Okafor, surgeon"]
    assert [one.by for one in found] == [*who, "A, B"]
    assert [one.bad for one in found] == [False, False, True, False, False, False, True]
    assert found[-1].what == "The answers to task 1 differ, so nothing is done (A: yes; B: no)"
    assert (
        told(Held(t=0.0, reason="why", details=("a", "b")), COMMANDS).what
        == "The run holds: why: a; b"
    )
    assert told(Held(t=0.0, reason="why"), COMMANDS).bad
    assert told(StateChecked(t=0.0, address="a", result="unknown", unknown=("f",)), COMMANDS).bad
    assert not told(StateChecked(t=0.0, address="a", result="true"), COMMANDS).bad


def test_what_is_too_much_is_counted(monkeypatch: pytest.MonkeyPatch, run: LoggedRun) -> None:
    monkeypatch.setattr(page, "MOST", 4)
    seen = Page(account_of(run))
    assert len(seen.rows) == 5
    assert "And 13 more events, which the log has." in seen.under("p")
    long = RoutePlanned(t=0.0, goal="a", operations=("b",) * 2, cost=2.0)
    seen = Page(account_of(logged(long, long, long)))
    assert len(seen.under("li")) == 2
    assert "Further routes are left out here; the log has them." in seen.under("p")
