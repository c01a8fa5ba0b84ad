"""The design cycle of a blueprint: who made each stage, and what goes out of date with what."""

from __future__ import annotations

import json
import os
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.front.design.cycle import DesignCycle, design_cycle
from smsl_studio.front.design.notes import DesignNotes, StageNote, notes_beside, write_notes
from smsl_studio.front.design.stages import (
    EMPTY,
    INCOMPLETE,
    MODEL,
    OUTDATED,
    PERSON,
    RULES,
    SETTLED,
    UNINSPECTED,
    WORDS,
)
from smsl_studio.front.installed import allow_generated
from smsl_studio.shipped import samples_dir
from tests.approval import DOOR, PASSPHRASE, make_keys_cheap
from tests.cases import case

TEXTS = samples_dir() / "texts"
LAMP = "# Lamp\n\n1. Switch the lamp on.\n2. Look at the light.\n3. Switch the lamp off.\n"


def cycle_of(file: Path) -> DesignCycle:
    return design_cycle(smsl.read(file), file)


def standings(found: DesignCycle) -> list[str]:
    return [one.standing for one in found.stages]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a text, a list of hardware, and all that was made of them."""
    folder = tmp_path_factory.mktemp("made")
    (folder / "lamp.md").write_text(LAMP, "utf-8")
    (folder / "list.md").write_text("# Hardware\n\n- Lamp: on the desk\n", "utf-8")
    file = folder / "lamp.json"
    smsl.generate_text([folder / "lamp.md"], file, hardware=folder / "list.md")
    blueprint = smsl.read(file)
    smsl.generate_code(blueprint, folder / "code")
    smsl.run(blueprint, log=folder / "run.jsonl")
    return folder


@pytest.fixture
def file(made: Path, tmp_path: Path) -> Path:
    """The blueprint in a copy of that folder."""
    shutil.copytree(made, tmp_path / "here")
    return tmp_path / "here" / "lamp.json"


def test_a_drawing_with_nothing_beside_it_has_empty_stages_that_say_so() -> None:
    found = cycle_of(samples_dir() / "registration.json")
    drawn = [3, 5, 6, 7, 9]
    assert [one.number for one in found.stages if one.standing == EMPTY] == [1, *drawn]
    assert {one.foot for one in found.stages if one.standing == EMPTY} == {"Not begun"}
    maker = found.stage(2).maker
    assert maker is not None
    assert (maker.kind, maker.words) == (PERSON, "Drawn by hand")
    # Nobody needs a text for a drawing, so it is no next step; everything else that is missing is.
    assert [one.number for one in found.next] == drawn
    empty = design_cycle(smsl.read(samples_dir() / "registration.json"))
    assert standings(empty) == standings(found)


def test_what_a_text_was_made_into_says_who_made_it_and_that_nobody_has_looked(file: Path) -> None:
    found = cycle_of(file)
    new, old = UNINSPECTED, SETTLED
    assert standings(found) == [old, new, EMPTY, new, old, old, old, old, EMPTY]
    assert found.stage(1).verdict.words == "2 texts, 8 lines"
    assert found.stage(2).verdict.words == "7 of 7 have a source"
    assert found.stage(5).verdict.words == "3 functions not written"
    assert found.stage(7).verdict.words == "Goal reached"
    assert [one.sources[0].line for one in found.parts if one.operation] == [3, 4, 5]
    assert [(one.number, one.who) for one in found.next] == [
        (2, "a person"), (3, "rules"), (5, "a person"), (9, "a person"),
    ]  # fmt: skip
    kept = json.loads((file.parent / "answers.json").read_text("utf-8"))
    for one in kept["answers"]:
        one["model"] = "small#7"
    (file.parent / "answers.json").write_text(json.dumps(kept), "utf-8")
    maker = cycle_of(file).stage(6).maker
    assert maker is not None
    assert (maker.kind, maker.words) == (MODEL, "Model small#7")


def test_each_change_takes_along_what_was_made_of_it_and_nothing_else(file: Path) -> None:
    folder, text = file.parent, file.read_text("utf-8")
    by_text = {2: (1,), 4: (1,), 5: (1,), 6: (1,), 7: (1,), 8: (1,)}
    changes = {
        "the text": (folder / "lamp.md", f"{LAMP}4. Go home.\n", by_text),
        "the list": (folder / "list.md", "# Hardware\n\n- Torch\n", {6: (1,), 7: (1,)}),
        "a title": (file, text.replace("Look at the light", "Look"), {5: (4,), 7: (4,)}),
        "a comment": (file, text.replace('"_origin": {', '"_x": 1, "_origin": {'), {}),
        "an operation": (file, text.replace('"Op_LookLight"', '"Op_Look"'), {5: (4,), 7: (4,)}),
    }
    for name, (path, content, changed) in changes.items():
        with case(name):
            before = path.read_text("utf-8")
            assert content != before
            path.write_text(content, "utf-8")
            found = cycle_of(file)
            assert {one.number: one.changed for one in found.stages if one.changed} == changed
            assert found.counts().get(OUTDATED, 0) == len(changed)
            path.write_text(before, "utf-8")


def test_the_time_of_a_file_changes_nothing(file: Path) -> None:
    before = cycle_of(file)
    for number, path in enumerate(sorted(file.parent.rglob("*"))):
        os.utime(path, (number * 1e6, number * 1e6))
    after = cycle_of(file)
    assert standings(after) == standings(before)
    assert [one.digest for one in after.stages] == [one.digest for one in before.stages]


def test_an_edit_by_hand_changes_who_made_it(file: Path) -> None:
    before = cycle_of(file)
    text = file.read_text("utf-8").replace('"Op_LookLight"', '"Op_Look"')
    file.write_text(text, "utf-8")
    after = cycle_of(file)
    for number in (2, 4):
        now, then = after.stage(number).maker, before.stage(number).maker
        assert now is not None
        assert then is not None
        assert (then.kind, now.kind) == (RULES, PERSON)
        assert now.words == "Reader, no model, then by hand"


def test_a_note_holds_for_the_digests_for_which_it_was_written(file: Path) -> None:
    digests = cycle_of(file).digests
    swept = StageNote(
        stage=7, kind="rules", who="Sweep, world table", words="Sweep 3 of 3",
        of={name: digests[name] for name in ("blueprint", "devices")},
    )  # fmt: skip
    doubts = ("1 caution stands in pm.md, and no hazard",)
    notes = DesignNotes((file.parent / "lamp.md",), doubts=doubts, done={7: swept})
    write_notes(notes, str(file))
    found = cycle_of(file)
    assert found.notes == notes
    assert found.next[1].what == "look again at 1 point"
    assert (found.stage(7).verdict.words, found.stage(7).standing) == ("Sweep 3 of 3", SETTLED)
    file.with_suffix(".toml").write_text(
        '[world.table.operations]\n"Op_LookLight" = {function = "lamp.look"}\n', "utf-8"
    )
    found = cycle_of(file)
    assert found.stage(7).changed == (6,)
    assert [one.number for one in found.next] == [2, 2, 3, 5, 7, 9]
    # A person says that the states still hold for the text as it is now.
    (file.parent / "lamp.md").write_text(f"{LAMP}\nThank you.\n", "utf-8")
    assert cycle_of(file).stage(2).foot == "Stage 1 changed"
    of = {"texts": cycle_of(file).digests["texts"]}
    looked = StageNote(stage=2, kind="person", who="Ada", of=of)
    write_notes(replace(notes, done={2: looked}), str(file))
    found = cycle_of(file)
    assert [one.number for one in found.stages if one.own] == [6]


def test_a_signature_settles_what_was_generated_until_the_next_edit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_keys_cheap(monkeypatch)
    file = tmp_path / "door.json"
    file.write_text(json.dumps(DOOR | {"_origin": {"how": "explore"}}), "utf-8")
    smsl.make_key("Ada Lovelace", "engineer", PASSPHRASE.encode(), "ada")
    assert cycle_of(file).stage(2).standing == UNINSPECTED
    smsl.approve(smsl.ApprovalRequest(smsl.read(file), "ada", PASSPHRASE.encode()))
    signed = cycle_of(file)
    assert signed.stage(2).standing == SETTLED
    assert signed.stage(9).verdict.words == "Approved by 1"
    file.write_text(file.read_text("utf-8").replace("close", "shut"), "utf-8")
    edited = cycle_of(file)
    assert edited.stage(9).foot == "Stage 4 changed"
    assert edited.stage(2).standing == UNINSPECTED


def test_requirements_are_told_with_their_verdicts(made: Path, tmp_path: Path) -> None:
    require = tmp_path / "require.toml"
    require.write_text('required = ["Op_Look*"]\nforbidden = ["Op_Switch*"]\n', "utf-8")
    file = tmp_path / "lamp.json"
    smsl.generate_text([made / "lamp.md"], file, require=require)
    found = cycle_of(file)
    assert [one.verdict for one in found.requirements] == ["holds", "fails"]
    assert found.stage(2).verdict.words == "1 requirement not met"
    # The text lies elsewhere, and nobody has told where.
    assert found.stage(1).foot == "lamp.md is not here"


def test_generated_functions_wait_until_a_person_has_read_them(file: Path) -> None:
    place = file.parent / "rmm" / "LAMP.Op_LookLight.py"
    place.write_text("def op_look_light(world):\n    yield\n", "utf-8")
    found = cycle_of(file)
    assert found.functions.written == ("LAMP/Op_LookLight",)
    assert found.stage(5).foot == "Generated, not inspected"
    assert "read 1 function" in [one.what for one in found.next]
    proposal = found.functions.proposal
    assert proposal is not None
    allow_generated(proposal, proposal.digest)
    assert cycle_of(file).stage(5).verdict.words == "2 functions not written"
    # Other code, if only one character, is read anew; what reaches out of its world cannot be.
    place.write_text("def op_look_light(world):\n    yield  #\n", "utf-8")
    assert cycle_of(file).stage(5).verdict.words == "1 function not read"
    place.write_text("import os\n\n\ndef op_look_light(world):\n    yield\n", "utf-8")
    found = cycle_of(file)
    assert found.stage(5).verdict.words == "Functions reach too far"
    assert "import" in found.functions.fault


def test_what_is_missing_says_so(file: Path) -> None:
    (file.parent / "lamp.md").rename(file.parent / "elsewhere.md")
    him = file.parent / "him.toml"
    need = '\n[[needed]]\nname = "torch"\nkind = "device"\nsteps = []\n'
    him.write_text(him.read_text("utf-8") + need, "utf-8")
    broken = json.loads(file.read_text("utf-8"))
    broken["LAMP"]["_sources"].pop("Op_LookLight")
    file.write_text(json.dumps(broken), "utf-8")
    found = cycle_of(file)
    assert (found.stage(1).standing, found.stage(1).foot) == (INCOMPLETE, "lamp.md is not here")
    assert (found.stage(6).standing, found.stage(6).foot) == (INCOMPLETE, "torch is missing")
    assert found.stage(2).verdict.words == "6 of 7 have a source"
    told = {one.number: one.what for one in found.next}
    assert told[2] == "cite Op_LookLight or drop it"


def test_hostile_files_beside_it_are_passed_over(file: Path) -> None:
    folder = file.parent
    deep = "[" * 100_000
    for name in ("answers.json", "him.toml", "psm.json", "requirements.json", "run.jsonl"):
        (folder / name).write_text(deep, "utf-8")
    (folder / "campaign.json").write_text('{"runs": "many", "reached": [], "digest": 1}', "utf-8")
    (folder / "loop").symlink_to(folder)
    os.mkfifo(folder / "pipe.jsonl")
    for content in (deep, '{"version": 1, "done": [{"stage": 10}]}', '{"version": 2}'):
        notes_beside(str(file)).write_text(content, "utf-8")
        found = cycle_of(file)
        assert found.fault.startswith("the notes of the design cycle cannot be read")
        assert found.stage(7).standing == EMPTY
    assert len(found.stages) == len(WORDS) == 9
