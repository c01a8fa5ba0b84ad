"""``check`` on a file with the conflict markers of a merge by lines."""

from __future__ import annotations

from pathlib import Path

from tests.cli.shell import Shell


def test_check_says_it_in_one_sentence_with_line_and_advice(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "plan.json"
    file.write_text('{\n<<<<<<< HEAD\n "A": {}\n=======\n "B": {}\n>>>>>>> other\n}\n')
    done = shell("check", str(file))
    assert done.status == 2
    assert f"{file}:2:1" in done.err
    assert "the conflict markers of a merge by lines stand in the file, in 1 place" in done.err
    assert "page Merge" in done.err
