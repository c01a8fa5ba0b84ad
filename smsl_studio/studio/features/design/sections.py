"""What stands beside a chosen stage: sections of rows, each with the place to which it leads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.comparison.compare import compare
from smsl_studio.blueprint.comparison.difference import Change
from smsl_studio.blueprint.comparison.signs import ADDED, REMOVED, sign_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.design import stages
from smsl_studio.front.design.cycle import DesignCycle
from smsl_studio.front.design.parts import MadePart
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS
from smsl_studio.inspection.rules.finding import Severity
from smsl_studio.studio.base.words import counted

MOST = 200
"""So many rows of a section are shown."""
AS_WRITTEN = "Shown for this blueprint as written, if every operation does what its edge says"
_MARKS = {HOLDS: stages.GOOD, FAILS: stages.BAD}
_SIGNS = {ADDED: ("plus", stages.GOOD), REMOVED: ("minus", stages.BAD)}
_CHANGED = ("wave", stages.PLAIN)


@dataclass(frozen=True)
class SideRow:
    """A row: words, words at the right, a mark, an icon in its place, and where a click leads: to
    the ``address`` of an element, or to a ``line`` of a text (name, line, page)."""

    words: str
    right: str = ""
    mark: str = ""
    icon: str = ""
    address: str = ""
    line: tuple[str, int, int] | None = None


@dataclass(frozen=True)
class SideSection:
    """A title, words at its right, and rows. Without rows it says ``empty``. ``parts`` are shown
    with the words from which they were made."""

    title: str
    right: str = ""
    rows: tuple[SideRow, ...] = ()
    empty: str = ""
    parts: tuple[MadePart, ...] = ()


def sections_of(
    cycle: DesignCycle, number: int, blueprint: Blueprint, waiting: Sequence[Change] | None
) -> tuple[SideSection, ...]:
    """Return what stands beside a stage. ``waiting`` are the changes of a new generation that was
    not taken yet, None if there is none."""
    build = {
        stages.TEXT: _texts, stages.FSM: _states, stages.BRANCHES: _branches,
        stages.HFSM: _whole, stages.CODE: _code, stages.HARDWARE: _hardware,
        stages.TESTING: _testing, stages.INSPECTION: _inspection, stages.APPROVAL: _approval,
    }[number]  # fmt: skip
    found = list(build(cycle, blueprint))
    if number in (stages.FSM, stages.HFSM):
        # What waits for a decision stands first.
        found.insert(
            0 if waiting is not None else len(found), _differences(cycle, blueprint, waiting)
        )
    return tuple(found)


def _texts(cycle: DesignCycle, _: Blueprint) -> Iterator[SideSection]:
    if cycle.fault:
        yield SideSection("Notes", rows=(SideRow(cycle.fault, mark=stages.WARNING),))
    for title, texts, empty in (
        ("Texts", cycle.texts, "No text. Choose what somebody has written who knows it."),
        ("Lists of hardware", cycle.hardware, "No list of hardware."),
    ):
        rows = [
            SideRow(
                one.lacks or one.name,
                counted(len(one.text.lines), "line") if one.text is not None else "",
                stages.BAD if one.lacks else stages.GOOD,
                line=(one.name, 1, 0) if one.text is not None else None,
            )
            for one in texts
        ]
        yield SideSection(title, rows=tuple(rows), empty=empty)


def _states(cycle: DesignCycle, blueprint: Blueprint) -> Iterator[SideSection]:
    if cycle.notes.doubts and not cycle.approval.is_good:
        rows = [SideRow(one, mark=stages.WARNING) for one in cycle.notes.doubts]
        yield SideSection("Look again", str(len(rows)), tuple(rows))
    parts = cycle.parts
    cited = sum(bool(one.sources) for one in parts)
    right = f"{cited} of {len(parts)} have a source" if parts else ""
    drawn = "Drawn by hand: it cites no text."
    empty = drawn if blueprint.state_count else "Nothing is made yet."
    yield SideSection("Expert text, and what was made from it", right, (), empty, parts[:MOST])
    verdicts = cycle.requirements
    rows = [SideRow(f"{one.kind.capitalize()}: {one.name}", f"{one.verdict}: {one.reason}",
                    _MARKS.get(one.verdict, stages.UNKNOWN)) for one in verdicts]  # fmt: skip
    empty = "None. A file of requirements says what a generation must fulfil."
    yield SideSection("Requirements", str(len(rows) or ""), tuple(rows[:MOST]), empty)


def _differences(
    cycle: DesignCycle, blueprint: Blueprint, waiting: Sequence[Change] | None
) -> SideSection:
    before = cycle.generation
    if waiting is not None:
        title, changes = "Differences of the new generation", tuple(waiting)
        empty = "None. It is the same, made of the texts as they are now."
    elif before is not None:
        title, changes = (
            "Changed by hand since it was generated",
            compare(before, blueprint).changes,
        )
        empty = "Nothing."
    else:
        return SideSection("Differences of the last generation", empty="It was not generated here.")
    rows = [
        SideRow(one.words, "", mark, icon, str(one.address or ""))
        for one in changes
        for icon, mark in (_SIGNS.get(sign_of(one.kind), _CHANGED),)
    ]
    signs = [sign_of(one.kind) for one in changes]
    added, removed = signs.count(ADDED), signs.count(REMOVED)
    right = f"+{added}  −{removed}  ~{len(signs) - added - removed}" if signs else ""
    return SideSection(title, right, tuple(rows[:MOST]), empty)


def _branches(_: DesignCycle, blueprint: Blueprint) -> Iterator[SideSection]:
    rows = []
    for branch in blueprint:
        for digit, sub in branch.subs.items():
            states = len(blueprint.branches[sub].table) if sub in blueprint.branches else 0
            words = f"{sub} expands “{branch.fact_name(digit)}” of {branch.name}"
            rows.append(SideRow(words, counted(states, "state"), icon="layers", address=sub))
    empty = "One State Branch. Try the cuts: rules look for states that could be one of their own."
    yield SideSection("Sub-SBs", str(len(rows) or ""), tuple(rows[:MOST]), empty)


def _whole(cycle: DesignCycle, _: Blueprint) -> Iterator[SideSection]:
    found = [one for one in cycle.check.findings if one.severity is not Severity.NOTE]
    rows = [
        SideRow(f"{one.address.path[-1]}: {one.message}", one.rule, address=str(one.address),
                mark=stages.BAD if one.severity is Severity.ERROR else stages.WARNING)
        for one in found[:MOST]
    ]  # fmt: skip
    yield SideSection("Errors and warnings", str(len(found) or ""), tuple(rows), "None.")


def _code(cycle: DesignCycle, _: Blueprint) -> Iterator[SideSection]:
    stage = cycle.stage(stages.CODE)
    rows = [SideRow(stage.verdict.words, mark=stage.verdict.mark)] if stage.verdict.words else []
    empty = "No program. Rules write one from the blueprint, the same each time."
    yield SideSection("Program", rows=tuple(rows), empty=empty)
    functions = cycle.functions
    state = "allowed, counts after its sweep" if functions.is_read else "not read, not loaded"
    own = [SideRow(one, state, stages.GOOD if functions.is_read else stages.UNKNOWN)
           for one in functions.written]  # fmt: skip
    if functions.fault:
        own = [SideRow(functions.fault, mark=stages.BAD)]
    empty = f"{counted(functions.skeletons, 'skeleton')} in rmm, and nobody has written them."
    none = "None. Every operation has a function, or a person does it."
    right = str(len(functions.written) or "")
    yield SideSection(
        "Generated functions", right, tuple(own[:MOST]), empty if functions.skeletons else none
    )


def _hardware(cycle: DesignCycle, blueprint: Blueprint) -> Iterator[SideSection]:
    needs = cycle.equipment.needs if cycle.equipment is not None else ()
    rows = [
        SideRow(one.name, f"met by {one.met_by}" if one.met_by else "missing",
                stages.GOOD if one.met_by else stages.BAD,
                line=_line(one.sources[0]) if one.sources else None)
        for one in needs
    ]  # fmt: skip
    empty = "No list of what is needed. A text with a list of hardware gives one."
    yield SideSection("Needed hardware", str(len(rows) or ""), tuple(rows[:MOST]), empty)
    levels = [SideRow(key, level) for key, level in blueprint.levels.items()]
    yield SideSection("Who acts and senses", rows=tuple(levels[:MOST]), empty="As usual.")


def _line(source: object) -> tuple[str, int, int]:
    return getattr(source, "file", ""), getattr(source, "line", 1), getattr(source, "page", 0)


def _testing(cycle: DesignCycle, _: Blueprint) -> Iterator[SideSection]:
    stage = cycle.stage(stages.TESTING)
    rows = [SideRow(stage.verdict.words, mark=stage.verdict.mark)] if stage.verdict.words else []
    empty = "Not tried. A sweep runs each operation alone; a campaign runs the whole with faults."
    yield SideSection("Tried", stage.maker.words if stage.maker else "", tuple(rows), empty)


def _inspection(cycle: DesignCycle, _: Blueprint) -> Iterator[SideSection]:
    rows = []
    for one in cycle.check.verdicts:
        many = f"{one.configurations:,} configurations" if one.configurations else ""
        rows.append(
            SideRow(one.name, one.bound or many, _MARKS.get(one.verdict, stages.UNKNOWN))
        )  # fmt: skip
    empty = "No property is written. The page Inspection adds one."
    yield SideSection("What must hold", AS_WRITTEN if rows else "", tuple(rows[:MOST]), empty)


def _approval(cycle: DesignCycle, _: Blueprint) -> Iterator[SideSection]:
    mark = stages.GOOD if cycle.approval.is_good else stages.WARNING
    first, *lines = cycle.approval.lines
    rows = [SideRow(first, mark=mark), *(SideRow(line) for line in lines)]
    yield SideSection("Signatures", rows=tuple(rows[:MOST]))
