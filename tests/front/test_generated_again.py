"""A text is generated again beside what people have written: nothing of that is lost."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.errors import UsageError
from smsl_studio.front import generated_text
from smsl_studio.front.design.base import generation_of
from smsl_studio.front.design.cycle import design_cycle
from smsl_studio.front.design.generation import (
    BLUEPRINT,
    NOTHING,
    OTHER,
    GenerationRequest,
    NewGeneration,
    generate_anew,
    keep_generation,
    taken,
)
from smsl_studio.front.design.notes import notes_beside
from smsl_studio.library.loaded import Loaded
from tests.cases import case

LAMP = "# Lamp\n\n1. Switch the lamp on.\n2. Look at the light.\n3. Switch the lamp off.\n"
KETTLE = "# Kettle\n\n1. Fill the kettle.\n2. Heat the water.\n"


@pytest.fixture(autouse=True)
def text(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A text. No plugin is asked, because that takes a process."""
    monkeypatch.setattr(generated_text, "describe", lambda: Loaded((), ()))
    text = tmp_path / "lamp.md"
    text.write_text(LAMP, "utf-8")
    return text


def with_operation(file: Path) -> str:
    """Add an operation by hand, and return the text of the file."""
    values = json.loads(file.read_text("utf-8"))
    values["LAMP"]["State_000"]["Op_ByHand"] = "State_111"
    file.write_text(json.dumps(values), "utf-8")
    return file.read_text("utf-8")


def anew(text: Path, target: Path) -> NewGeneration:
    return generate_anew(GenerationRequest((text,), target), text.parent / "new")


def test_a_file_in_the_place_of_a_new_blueprint_is_told_and_laid_aside(text: Path) -> None:
    target = text.parent / "made" / "lamp.json"
    first = anew(text, target)
    assert first.place == NOTHING
    keep_generation(first, own=True)
    mine = with_operation(target)
    again = anew(text, target)
    assert (again.place, again.has_base) == (BLUEPRINT, True)
    assert any("Op_ByHand" in one.words for one in again.changes)
    keep_generation(again, own=True)
    assert (target.parent / "former-1" / "lamp.json").read_text("utf-8") == mine
    target.write_text("my list", "utf-8")
    other = anew(text, target)
    assert (other.place, other.changes) == (OTHER, ())
    keep_generation(other, own=True)
    assert (target.parent / "former-2" / "lamp.json").read_text("utf-8") == "my list"
    assert "Op_ByHand" not in target.read_text("utf-8")
    # A text that is read is never moved away.
    page = text.rename(target.parent / "pm.md")
    with pytest.raises(UsageError, match=r"pm\.md is a text that is read"):
        anew(page, target)


def test_a_command_keeps_functions_and_pages_that_a_person_wrote(text: Path) -> None:
    out = text.parent / "made" / "lamp.json"
    assert smsl.generate_text([text], out).former == ""
    assert smsl.generate_text([text], out).former == ""
    function = out.parent / "rmm" / "LAMP.Op_LookLight.py"
    mine = {
        function: "def op_look_light(world):\n    yield\n",
        out.parent / "pm.md": "1. Switch it on.\n",
        out: with_operation(out),
        out.parent / "answers.json": json.dumps({"answers": [{"model": "large"}]}),
    }
    for path, content in mine.items():
        path.write_text(content, "utf-8")
    made = smsl.generate_text([text], out)
    assert made.former == str(out.parent / "former-1")
    for path, content in mine.items():
        with case(path.name):
            place = out.parent / "former-1" / path.relative_to(out.parent)
            assert place.read_text("utf-8") == content
            assert path.read_text("utf-8") != content
    assert smsl.generate_text([text], out).former == ""


def test_what_was_drawn_is_merged_with_the_generation_of_the_same_blueprint(text: Path) -> None:
    folder = text.parent / "made"
    kettle = text.with_name("kettle.md")
    kettle.write_text(KETTLE, "utf-8")
    for name in ("psm.json", "lamp.json"):
        with case(name):
            target = folder / name.removesuffix(".json") / name
            smsl.generate_text([text], target)
            mine = with_operation(target)
            if name != "psm.json":
                # Another blueprint of this folder writes the same psm.json.
                smsl.generate_text([kettle], target.with_name("kettle.json"))
            before = smsl.read(target)
            text.write_text(LAMP.replace("light", "bulb"), "utf-8")
            new = anew(text, target)
            assert new.has_base
            assert new.made.blueprint is not None
            base = generation_of(before, target)
            assert base is not None
            assert [one.name for one in base] == ["LAMP"]
            found = taken(before, base, new.made.blueprint)
            assert {"Op_ByHand", "Op_LookBulb"} <= set(found["LAMP"].operation_names)
            keep_generation(new)
            assert target.read_text("utf-8") == mine
            text.write_text(LAMP, "utf-8")
            assert generation_of(before, target) is not None
    drawn = folder / "lamp" / "drawn.json"
    drawn.write_text('{"A": {"HEADER": {"INITIAL": "S_0", "ACTIVATING": "S_0"}, "S_0": {}}}')
    assert generation_of(smsl.read(drawn), drawn) is None


def test_links_beside_a_blueprint_are_not_followed(text: Path) -> None:
    folder, outside = text.parent / "made", text.parent / "outside"
    folder.mkdir()
    outside.mkdir()
    (outside / "mine.py").write_text("mine", "utf-8")
    (outside / "pm.md").write_text("mine", "utf-8")
    (folder / "rmm").symlink_to(Path("..", "outside"))
    (folder / "pm.md").symlink_to(outside / "pm.md")
    (folder / "him.toml").symlink_to(outside / "nothing.toml")
    (folder / "lamp.json").symlink_to(outside / "pm.md")
    keep_generation(anew(text, folder / "lamp.json"), own=True)
    assert {one.name: one.read_text("utf-8") for one in outside.iterdir()} == {
        "mine.py": "mine", "pm.md": "mine",
    }  # fmt: skip
    assert not (folder / "rmm").is_symlink()
    assert (folder / "former-1" / "rmm" / "mine.py").read_text("utf-8") == "mine"
    linked = text.parent / "linked"
    linked.mkdir()
    (linked / "rmm").symlink_to(outside)
    with pytest.raises(UsageError, match="rmm is a link"):
        smsl.generate_text([text], linked / "lamp.json")
    hand = text.parent / "hand"
    hand.mkdir()
    (hand / "pm.prompt.md").symlink_to(outside / "pm.md")
    with pytest.raises(UsageError, match=r"pm\.prompt\.md is a link"):
        smsl.generate_text([text], text.parent / "b" / "lamp.json", by_hand=hand)
    assert (outside / "pm.md").read_text("utf-8") == "mine"


def test_notes_of_a_stranger_settle_nothing_and_open_no_file_elsewhere(text: Path) -> None:
    file = text.parent / "made" / "here" / "lamp.json"
    smsl.generate_text([text], file)
    blueprint = smsl.read(file)
    (file.parent / "x.json").write_text('{"runs":1e400,"reached":1,"digest":""}', "utf-8")
    (file.parent / "link.md").symlink_to(text)
    (file.parent.parent / "near.md").write_text(LAMP, "utf-8")

    def found(**notes: object) -> tuple[list[str], str, str]:
        notes_beside(str(file)).write_text(json.dumps({"version": 1, **notes}), "utf-8")
        cycle = design_cycle(blueprint, file)
        lacks = [one.lacks for one in cycle.texts if one.name != "lamp.md"]
        return lacks, cycle.fault, cycle.stage(7).standing

    assert "texts" in found(texts=["a\0b"])[1]
    assert found(texts=["a" * 4096])[0] == [f"{'a' * 300} is not here"]
    far = "lies outside the project and is not read"
    assert found(texts=["/etc/passwd", "../../lamp.md", "link.md"])[0] == [
        f"passwd {far}", f"link.md {far}",
    ]  # fmt: skip
    assert found(texts=["../near.md"])[0] == [""]
    assert found(hardware=["/etc/passwd"], require="/etc/passwd")[1] == f"passwd {far}"
    done = {"stage": 7, "kind": "person", "who": "A", "words": "good"}
    for of in ({}, {"devices": "0" * 64}, {"anything": "0" * 64}):
        with case(of):
            assert found(done=[{**done, "of": of}])[2] == "empty"
    assert found(done=[{**done, "of": {"blueprint": "0" * 64}}])[2] == "outdated"
