"""The stages of a design cycle behind the blueprint: code, hardware, tests, inspection, record."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.front.design import found
from smsl_studio.front.design.functions import FunctionsBeside
from smsl_studio.front.design.makers import BY_HAND, maker_of, model_of, newest
from smsl_studio.front.design.matter import CLOSURE, DEVICES, LIST, TEXTS, DesignMatter
from smsl_studio.front.design.stages import (
    APPROVAL,
    BAD,
    CODE,
    GOOD,
    HARDWARE,
    INSPECTION,
    PERSON,
    PHYSICS,
    RULES,
    TESTING,
    UNKNOWN,
    DesignStage,
    StageMaker,
    StageVerdict,
)
from smsl_studio.generate.text.functions import needed_functions
from smsl_studio.generate.text.prompts import FILES, HIM, RMM
from smsl_studio.inspection.approval.times import read_time
from smsl_studio.inspection.inspect import RULES as EVERY_RULE
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS
from smsl_studio.inspection.rules.finding import Severity
from smsl_studio.inspection.rules.words import counted
from smsl_studio.seal.digest import digest_of, sha256_hex
from smsl_studio.world.engines import TABLE


def code_stage(matter: DesignMatter) -> DesignStage:
    """Return stage 5: programs that carry it out, and functions that nobody has read."""
    here, every = matter.digests[CLOSURE], found.found_codes(matter.folder)
    codes = sorted(every, key=lambda one: (one.closure != here, one.folder))
    functions = matter.functions
    told = _functions_told(functions)
    if not codes and not told:
        return DesignStage(CODE)
    if not codes:
        return DesignStage(
            CODE, maker_of(model_of(matter, RMM)), verdict=StageVerdict(told, UNKNOWN),
            lacks="No program is written", is_generated=bool(functions.unread),
        )  # fmt: skip
    code = codes[0]
    words = f"{counted(code.files, 'file')} in {code.folder.name}"
    return DesignStage(
        CODE,
        StageMaker(RULES, "Rules"),
        digest_of({"code of": code.closure, "files": code.files}),
        newest([code.folder]),
        StageVerdict(told or words, UNKNOWN if told else GOOD),
        matter.changed({CLOSURE: code.closure}),
        is_generated=bool(functions.unread),
    )


def _functions_told(functions: FunctionsBeside) -> str:
    """Return what is to be done about generated functions; empty if nothing is."""
    if functions.fault:
        return "Functions reach too far"
    if functions.unread:
        return f"{counted(functions.unread, 'function')} not read"
    return f"{counted(functions.skeletons, 'function')} not written" if functions.skeletons else ""


def hardware_stage(matter: DesignMatter) -> DesignStage:
    """Return stage 6: which hardware there is, what is bound to it, who acts and senses."""
    digest, note = matter.digests.get(DEVICES, ""), matter.note(HARDWARE)
    equipment, head = matter.equipment, matter.head
    if not digest:
        return DesignStage(HARDWARE)
    verdict, lacks = _bound(matter)
    looked = note is not None and not matter.changed(note.of)
    of: dict[str, str] = {}
    if head is not None and equipment is not None:
        of = {TEXTS: _kept(head.texts), LIST: _kept(head.hardware)}
    files = [matter.folder / FILES[HIM]]
    if matter.path is not None:
        files.append(matter.path.with_suffix(".toml"))
    return DesignStage(
        HARDWARE,
        BY_HAND if equipment is None else maker_of(model_of(matter, HIM)),
        digest,
        newest(files),
        verdict,
        () if looked else matter.changed({name: one for name, one in of.items() if one}),
        lacks=lacks,
    )


def _bound(matter: DesignMatter) -> tuple[StageVerdict, str]:
    """Return the verdict of the hardware, and what is missing."""
    equipment, bindings = matter.equipment, matter.bindings
    if bindings is None:
        return StageVerdict("The bindings cannot be read", BAD), "The bindings cannot be read"
    bound = sum(len(one.operations) for one in bindings.worlds.values())
    if equipment is not None:
        missing, needs = equipment.missing, len(equipment.needs)
        words = f"{needs - len(missing)} of {needs} met"
        if missing:
            return StageVerdict(words, BAD), f"{missing[0]} is missing"
    else:
        words = f"{counted(bound, 'operation')} bound" if bound else "Levels are set"
    bare = needed_functions(matter.blueprint, matter.loaded) if matter.loaded is not None else {}
    if bare and not bound:
        return StageVerdict(f"{words}, {len(bare)} simulated", UNKNOWN), ""
    return StageVerdict(words, GOOD), ""


def _kept(texts: Sequence[found.DigestedText]) -> str:
    return sha256_hex("\n".join(one.digest for one in texts).encode()) if texts else ""


def testing_stage(matter: DesignMatter) -> DesignStage:
    """Return stage 7: sweep, campaign or run; the newest that says for which version it was."""
    note, here = matter.note(TESTING), matter.digests[CLOSURE]
    if note is not None:
        return DesignStage(
            TESTING, StageMaker(note.kind, note.who), digest_of(dict(note.of)), note.time,
            StageVerdict(note.words, GOOD if note.good else BAD), matter.changed(note.of),
            lacks="" if note.good else note.words,
        )  # fmt: skip
    runs = sorted(found.found_runs(matter.folder), key=lambda one: (one.closure != here, one.file))
    if runs:
        run = runs[0]
        good = run.outcome == "goal_reached"
        return DesignStage(
            TESTING,
            StageMaker(RULES if run.world == TABLE else PHYSICS, f"A run, world {run.world}"),
            digest_of([run.file.name, run.closure]),
            newest([run.file]),
            StageVerdict("Goal reached" if good else "Goal not reached", GOOD if good else BAD),
            matter.changed({CLOSURE: run.closure}),
            lacks="" if good else "The goal was not reached",
        )
    campaign = next(found.found_campaigns(matter.folder), None)
    if campaign is None:
        return DesignStage(TESTING)
    words = f"{campaign.reached:,} of {campaign.runs:,} runs reached"
    return DesignStage(
        TESTING, StageMaker(PHYSICS, "Campaign"), campaign.digest, newest([campaign.file]),
        StageVerdict(words, UNKNOWN), lacks="For which version is not known",
    )  # fmt: skip


def inspection_stage(matter: DesignMatter) -> DesignStage:
    """Return stage 8: the whole check of the blueprint as it is now, the same each time."""
    if not matter.blueprint.state_count:
        return DesignStage(INSPECTION)
    check = matter.check
    fails = sum(one.verdict == FAILS for one in check.verdicts)
    holds = sum(one.verdict == HOLDS for one in check.verdicts)
    unknown = len(check.verdicts) - fails - holds
    errors = len(check.of(Severity.ERROR))
    told = [f"{fails} fail" if fails else "", f"{holds} hold" if holds else "",
            f"{unknown} unknown" if unknown else ""]  # fmt: skip
    words = ", ".join(filter(None, told)) or f"{counted(errors, 'error')}, no property"
    lacks = f"{fails} of {len(check.verdicts)} properties do not hold" if fails else ""
    mark = BAD if fails or errors else UNKNOWN if unknown else GOOD
    result = [[one.rule, str(one.address), one.message] for one in check.findings]
    return DesignStage(
        INSPECTION,
        StageMaker(RULES, f"Rules, {len(EVERY_RULE)} looked at"),
        digest_of([result, [[one.name, one.verdict] for one in check.verdicts]]),
        None,
        StageVerdict(words, mark),
        lacks=lacks or (counted(errors, "error") if errors else ""),
    )


def approval_stage(matter: DesignMatter) -> DesignStage:
    """Return stage 9: the record beside the blueprint."""
    if not matter.records:
        return DesignStage(APPROVAL)
    said, last = matter.approval, matter.records[-1]
    people = list(dict.fromkeys(one.statement.predicate.person for one in matter.records))
    own = matter.changed({CLOSURE: last.statement.digests.closure})
    return DesignStage(
        APPROVAL,
        StageMaker(PERSON, people[0] if len(people) == 1 else f"{len(people)} people"),
        last.digest,
        read_time(last.statement.predicate.time).timestamp(),
        StageVerdict(said.words, GOOD if said.is_good else BAD),
        own,
        lacks="" if said.is_good or own else said.words,
    )
