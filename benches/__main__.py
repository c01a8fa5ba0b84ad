"""Run the benches: ``./dev bench`` for all, ``./dev bench load start`` for some.

``--write`` puts the rows into docs/benches.md, with the command that made them. ``--all`` runs the
benches that would take minutes (edits, fuzz) in full, not only a share of them. With
``--all --keep=FOLDER`` the counts of tampers and of forged runs go on from ``tampers.jsonl`` and
``forged.jsonl`` in that folder.
"""

from __future__ import annotations

import importlib
import inspect
import os
import platform
import sys
from collections.abc import Iterator
from pathlib import Path

from benches.row import Row

BENCHES = (
    "load",
    "inspect",
    "seeded",
    "dispatch",
    "replan",
    "start",
    "turns",
    "canvas",
    "window_edits",
    "source",
    "physics",
    "faults",
    "agents",
    "campaigns",
    "supervisors",
    "worlds",
    "previews",
    "atlas",
    "saving",
    "edits",
    "fuzz",
    "exchange",
    "generation",
    "hostile",
    "explored",
    "learn",
    "find",
    "journal",
    "compare",
    "histories",
    "merges",
    "record",
    "stories",
    "sensors",
    "traces",
    "world_traces",
    "replay",
    "reaction",
    "paced",
    "soak",
    "stopping",
    "oracle",
    "predicates",
    "bombs",
    "sequences",
    "undo",
    "walks",
    "layouts",
    "mental_map",
    "tidy",
    "pins",
    "plans",
    "proof",
    "readings",
    "shapes",
    "spin",
    "tampers",
    "frames",
    "forged",
    "code",
    "over_socket",
    "counts",
)
PAGE = Path(__file__).parent.parent / "docs" / "benches.md"


def rows(names: list[str], everything: bool, kept: Path | None) -> Iterator[tuple[str, Row]]:
    """Yield the rows of the named benches, each as soon as it is measured.

    ``kept`` is a folder. A long count goes on from its file there, such as ``forged.jsonl``.
    """
    for name in names:
        module = importlib.import_module(f"benches.{name}")
        make = getattr(module, "all_rows", module.rows) if everything else module.rows
        goes_on = kept is not None and "keep" in inspect.signature(make).parameters
        for row in make(kept / f"{name}.jsonl") if kept and goes_on else make():
            yield name, row


def line(name: str, row: Row) -> str:
    """Write one row of the Markdown table."""
    others = ", ".join(f"{other} {figure:,.4g}" for other, figure in row.others)
    ours = f"{row.ours:,.0f}" if row.ours >= 1e4 else f"{row.ours:,.4g}"
    cells = (name, row.work, f"{ours} {row.unit}", others, row.ratios(), row.bound)
    return "| " + " | ".join(cells) + " |"


READING = """\
Ratios travel between machines, times do not.

A figure *side by side* is a limit (nothing can be quicker) or a peer (another way to do it); below
1x we are quicker. What each bench does stands at the top of its file in [benches/](../benches/).
Times are CPU time unless they say so."""

HEAD = """| bench | work | ours | side by side | ours as a multiple | promise |
|---|---|---|---|---|---|"""


def _help(names: list[str]) -> str:
    """Return the descriptions of the named benches, or the list of all benches."""
    docs = [importlib.import_module(f"benches.{name}").__doc__ or "" for name in names]
    return "\n".join(docs) or f"{__doc__}\nBenches: {', '.join(BENCHES)}."


def main(arguments: list[str]) -> int:
    """Measure, print, and write the page if asked. Return 2 for an unknown bench."""
    if {"-h", "--help"} & set(arguments):
        print(_help([name for name in arguments if name in BENCHES]))
        return 0
    wanted = [name for name in arguments if not name.startswith("-")] or list(BENCHES)
    unknown = [name for name in wanted if name not in BENCHES]
    if unknown:
        print(f"no bench {unknown[0]!r}; there are {', '.join(BENCHES)}", file=sys.stderr)
        return 2
    print(HEAD, flush=True)
    lines = []
    everything = "--all" in arguments
    folder = next((one.partition("=")[2] for one in arguments if one.startswith("--keep=")), "")
    for name, row in rows(wanted, everything, Path(folder) if folder else None):
        lines.append(line(name, row))
        print(lines[-1], flush=True)
    if "--write" in arguments:
        machine = f"Python {platform.python_version()}, {os.cpu_count()} cores, {sys.platform}"
        command = " ".join(["./dev bench", *wanted, *["--all"] * everything, "--write"])
        made = f"Made by `{command}` on {machine}; rows of benches that it does not name are older."
        rows_of_all = "\n".join(_in_order([*lines, *_kept(wanted)]))
        text = f"# Benches\n\n{made}\n{READING}\n\n{HEAD}\n{rows_of_all}\n"
        PAGE.write_text(text, encoding="utf-8")
    return 0


def _kept(wanted: list[str]) -> list[str]:
    """Return the rows of the page for benches that were not measured now."""
    written = PAGE.read_text("utf-8").splitlines() if PAGE.exists() else []
    return [line for line in written if _bench_of(line) in set(BENCHES) - set(wanted)]


def _in_order(lines: list[str]) -> list[str]:
    return sorted(lines, key=lambda line: BENCHES.index(_bench_of(line)))


def _bench_of(line: str) -> str:
    return line.split("|")[1].strip() if line.startswith("| ") else ""


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
