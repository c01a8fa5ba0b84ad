"""The questions of the stages: each example in them is an answer that fits."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from smsl_studio.errors import ReadError
from smsl_studio.generate.text import stage_words
from smsl_studio.generate.text.answers import fitted, json_of
from smsl_studio.generate.text.blueprint_answer import blueprint_of_answer
from smsl_studio.generate.text.by_hand_provider import AnswerFolder
from smsl_studio.generate.text.equipment import NeededEquipment, read_equipment_page
from smsl_studio.generate.text.expert_text import read_text
from smsl_studio.generate.text.functions import (
    Functions,
    NeededFunction,
    file_names,
    function_files,
    functions_manifest,
)
from smsl_studio.generate.text.provider import Matter, StageQuestion
from smsl_studio.generate.text.step_numbers import numbered
from smsl_studio.generate.text.step_page import step_page
from smsl_studio.generate.text.step_reader import read_steps
from smsl_studio.generate.text.steps import Remedy
from smsl_studio.inspection.inspect import inspect
from smsl_studio.library.generated_functions import is_skeleton
from smsl_studio.library.generated_reach import parsed
from smsl_studio.library.manifest import read_manifest

PROTOCOL = b"""The nurse fixes the leg. If it moves, fix it again.
Match bone and scan:
a) Touch the points within 60 s
b) Compute, high risk, 5 s; the surgeon confirms
"""


def example(words: str, begin: str, end: str) -> str:
    return words[words.index(begin) : words.index(end)]


def test_the_example_of_the_psm_is_an_answer_without_a_fault() -> None:
    texts = [read_text(PROTOCOL, "protocol.md")]
    blueprint, _ = blueprint_of_answer(json_of(stage_words.PSM_EXAMPLE), texts)
    found = {one.rule for one in inspect(blueprint) if one.severity.value in ("E", "W")}
    assert found <= {"R10", "R22"}  # its failure is entered from outside, and its risk is high


def test_the_example_of_the_pm_reads_as_it_is_meant() -> None:
    page = example(stage_words.PM_FILE, "# Title", "The keys of a step")
    procedure = numbered(read_steps([read_text(page.encode(), "pm.md")]))
    fix, match = procedure.steps
    assert (fix.who, fix.until, fix.within) == ("nurse", "the leg does not move", 60)
    (remedy,) = fix.remedies
    assert (remedy.do, remedy.back, remedy.who) == ("Fix it again", "again", "nurse")
    assert remedy.sources[0].line == 13
    touch, wait = match.steps
    assert (touch.confirm, wait.wait, wait.takes) == (("surgeon",), True, 5)
    assert wait.sources[0].page == 2
    (caution,) = procedure.cautions
    assert caution.sources[0].line == 20
    again = read_text(step_page(procedure, {}).encode(), "pm.md")
    assert numbered(read_steps([again])) == procedure


def test_the_example_of_the_him_is_an_answer_and_numbers_are_numbers_of_steps() -> None:
    page = example(stage_words.HIM_FILE, "[[device]]", "kind is device")
    (need,) = fitted(NeededEquipment, read_equipment_page(page)).needs
    assert need.steps == ("1", "2.1")
    page = page.replace('["1", "2.1"]', "[1, 2.1]")
    assert tomllib.loads(page)
    assert fitted(NeededEquipment, read_equipment_page(page)).needs[0] == need


@pytest.mark.parametrize(
    ("line", "advice"),
    [
        ("- source: lamp.md, line 3: Plug it in", "the quoted words"),
        ("- source: lamp.md: “Plug it in”", "the quoted words"),
        ("- if: it smokes: pull the plug", "what is wrong -> what is done"),
        ("- within: soon", "20 s"),
        ("- risk: some", "medium"),
    ],
)
def test_a_line_of_an_answer_that_says_nothing_is_told(
    tmp_path: Path, line: str, advice: str
) -> None:
    (tmp_path / "pm.md").write_text(f"1. Plug it in\n   {line}\n")
    texts = [read_text(b"1. Plug it in\n", "lamp.md")]
    with pytest.raises(ReadError, match=r"pm\.md:2:1: this line says nothing") as caught:
        AnswerFolder(tmp_path).answer(StageQuestion("pm", "", 1, Matter(texts)))
    assert advice in caught.value.advice


def test_a_remedy_that_a_person_does_is_still_theirs_on_the_page() -> None:
    assert Remedy(when="a", do="b", who="nurse").who == "nurse"
    text = read_text(b"1. Look. If it is red, the nurse cools it.\n", "lamp.md")
    procedure = numbered(read_steps([text]))
    assert procedure.steps[0].remedies[0].who == "nurse"
    again = read_text(step_page(procedure, {}).encode(), "pm.md")
    assert numbered(read_steps([again])).steps == procedure.steps


def test_files_of_functions_have_names_of_their_own() -> None:
    names = file_names(["A/Op x", "A/Op_x", "A/op_X", "A/../b"])
    assert list(names.values()) == ["A.Op_x.py", "A.Op_x_2.py", "A.op_X_3.py", "A..._b.py"]


def test_the_manifest_of_functions_is_read_whatever_operations_are_called(tmp_path: Path) -> None:
    operations = ["\u00c4CUP/Op_fill", "\u00c4/\u00d6", "_A/pass", "A/\U0001d504", f"A/{'o' * 900}"]
    names = file_names(operations)
    assert list(names.values())[:3] == ["CUP.Op_fill.py", "operation.py", "A.pass.py"]
    file = tmp_path / "plugin.toml"
    file.write_text(functions_manifest(names, "cup"), "utf-8")
    manifest = read_manifest(file)
    assert [(one.operation, one.file) for one in manifest.generated] == list(names.items())
    needed = {operation: NeededFunction(operation) for operation in operations}
    for one, (_, text) in zip(
        manifest.generated, function_files(Functions(), needed, names, {}), strict=True
    ):
        assert is_skeleton(parsed(text, one.file, one.function))
