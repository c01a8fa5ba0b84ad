"""``render``, and the picture of ``diff``: files of the right kind, chosen SBs, plain refusals."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.shell import Shell, sample

BEGIN = {"svg": b"<svg ", "png": b"\x89PNG", "pdf": b"%PDF"}


@pytest.mark.parametrize("form", BEGIN)
def test_a_picture_is_written(form: str, shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / f"out.{form}"
    answer = shell("render", sample("hfsm"), "-o", str(out))
    assert (answer.status, answer.out, answer.err) == (0, "", "")
    assert out.read_bytes().startswith(BEGIN[form])


def test_only_the_chosen_sbs_are_drawn(shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / "out.svg"
    assert shell("render", sample("hfsm"), "-o", str(out), "--sb", "SB2").status == 0
    svg = out.read_text("utf-8")
    assert ">SB2<" in svg
    assert ">SB1<" not in svg


@pytest.mark.parametrize("form", BEGIN)
def test_operations_between_two_states_are_one_line(
    form: str, shell: Shell, tmp_path: Path
) -> None:
    out, whole = tmp_path / f"out.{form}", tmp_path / f"whole.{form}"
    assert shell("render", sample("registration"), "-o", str(out), "--collapse").status == 0
    assert shell("render", sample("registration"), "-o", str(whole)).status == 0
    assert out.read_bytes().startswith(BEGIN[form])
    assert out.read_bytes() != whole.read_bytes()
    if form == "svg":
        assert out.read_text("utf-8").count("<polyline") < whole.read_text("utf-8").count(
            "<polyline"
        )
    refused = shell("render", sample("registration"), "-o", str(out), "--collapse", "--map")
    assert refused.status == 2
    assert "the map shows no operations" in refused.err


def test_what_cannot_be_drawn_or_written(shell: Shell, tmp_path: Path) -> None:
    assert shell("render", sample("hfsm")).status == 2
    wrong = shell("render", sample("hfsm"), "-o", str(tmp_path / "out.gif"))
    assert wrong.status == 2
    assert "Let it end in .svg, .png or .pdf." in wrong.err
    absent = shell("render", sample("hfsm"), "-o", str(tmp_path / "out.svg"), "--sb", "SB3")
    assert absent.status == 2
    assert "Did you mean SB" in absent.err
    nowhere = shell("render", sample("hfsm"), "-o", str(tmp_path / "no" / "out.svg"))
    assert nowhere.status == 2
    assert "was not saved" in nowhere.err
    empty = tmp_path / "empty.json"
    empty.write_text("{}")
    assert shell("render", str(empty), "-o", str(tmp_path / "out.svg")).status == 2


@pytest.mark.parametrize("form", BEGIN)
def test_states_that_stand_very_far_apart_are_drawn(
    form: str, shell: Shell, tmp_path: Path
) -> None:
    far, out = tmp_path / "far.json", tmp_path / f"out.{form}"
    layout = '"_layout": {"S": [-1000000, 0], "T": [1000000, 1000000]}'
    far.write_text(f'{{"A": {{"S": {{"x": "T"}}, "T": {{"y": "S"}}, {layout}}}}}')
    answer = shell("render", str(far), "-o", str(out))
    assert (answer.status, answer.err) == (0, "")
    assert out.read_bytes().startswith(BEGIN[form])


@pytest.mark.parametrize("form", BEGIN)
def test_a_file_whose_name_is_no_text_is_drawn(form: str, shell: Shell, tmp_path: Path) -> None:
    odd, out = tmp_path / "odd\udcff\n.json", tmp_path / f"out.{form}"
    odd.write_text('{"A": {"S": {}}}')
    answer = shell("render", str(odd), "-o", str(out))
    assert (answer.status, answer.err) == (0, "")
    assert out.read_bytes().startswith(BEGIN[form])
    assert shell("diff", str(odd), sample("hfsm"), "-o", str(out)).status == 1


def test_a_picture_does_not_tell_in_which_folder_its_blueprint_stands(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "plan.json").write_bytes(Path(sample("hfsm")).read_bytes())
    monkeypatch.chdir(tmp_path)
    for name, out in (("plan.json", "a.svg"), (str(tmp_path / "plan.json"), "b.svg")):
        assert shell("render", name, "-o", out).status == 0
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    assert "<title>plan.json</title>" in (tmp_path / "a.svg").read_text("utf-8")


def test_diff_draws_both_sides(shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / "out.svg"
    answer = shell("diff", sample("hanoi"), sample("hanoi-corrected"), "-o", str(out))
    assert answer.status == 1
    assert answer.out.splitlines()[-1] == "2 changes: 2 renamed."
    svg = out.read_text("utf-8")
    assert ">before<" in svg
    assert ">after<" in svg
    assert shell("diff", sample("hanoi"), sample("hanoi"), "-o", "out.txt").status == 2


@pytest.mark.parametrize("form", BEGIN)
def test_the_map_of_branches_is_written(form: str, shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / f"map.{form}"
    answer = shell("render", sample("three-levels"), "--map", "-o", str(out), "--theme", "dark")
    assert (answer.status, answer.out, answer.err) == (0, "", "")
    assert out.read_bytes().startswith(BEGIN[form])


def test_the_map_shows_all_branches_or_is_refused(shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / "map.svg"
    assert shell("render", sample("three-levels"), "--map", "-o", str(out)).status == 0
    assert all(f">{name}<" in out.read_text("utf-8") for name in ("SURGERY", "DIGITIZATION"))
    one = shell("render", sample("hfsm"), "--map", "--sb", "SB2", "-o", str(out))
    assert (one.status, "the map shows all State Branches" in one.err) == (2, True)
    assert shell("render", sample("hfsm"), "--map", "-o", str(tmp_path / "map.gif")).status == 2
