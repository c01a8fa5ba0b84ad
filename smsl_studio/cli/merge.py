"""``merge``: merges two versions of a blueprint by meaning. The exit status is 1 if conflicts stay
open.

git can call it as a merge driver: ``smsl-studio merge %O %A %B --name=%P``.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from smsl_studio.blueprint.merge import ABSENT, KEY, Conflict, Merge, read_conflicts
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import inputs_of, note_stand_ins, read_argument
from smsl_studio.cli.merge_of_lines import by_lines
from smsl_studio.cli.output import Output, note, note_losses
from smsl_studio.errors import UsageError
from smsl_studio.front.inputs import read_bytes
from smsl_studio.front.outputs import converted, form_of, merge
from smsl_studio.legible import one_line
from smsl_studio.smsl.files import read_content, save_document


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``merge``."""
    parser.add_argument("base", metavar="BASE", help="the version that both sides come from")
    parser.add_argument("ours", metavar="OURS", help="your version; conflicts keep it")
    parser.add_argument("theirs", metavar="THEIRS", help="the other version")
    parser.add_argument(
        "-o", "--output", metavar="OUT", help="where the merged blueprint goes (default: OURS)"
    )
    parser.add_argument(
        "--name",
        metavar="NAME",
        help="the name of the file in the project, if the three files have other names, as those "
        "of git",
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Merge, write the result and list the conflicts. 0: none is open; 1: some are."""
    files = [options.base, options.ours, options.theirs]
    if files.count("-") > 1:
        raise UsageError("standard input can be one of the files only", advice="Name the others.")
    target = options.ours if options.output is None else options.output
    if target in ("-", ""):
        raise UsageError("there is no file to write to", advice="Name one with -o OUT.")
    over = None
    if options.output is None:
        over = read_content(target).seen
    else:
        form_of(options.output)
    if options.name is not None and options.output is None:
        lines = by_lines(files, options.name)
        if lines is not None:
            if options.format == "json":
                out.json({"conflicts": [], "layout_kept": [], "by_lines": True})
            return lines
    base, ours, theirs = (_read(file, options.name) for file in files)
    done = merge(base, ours, theirs)
    named = target
    if options.name is not None and options.output is None:
        named = options.name  # git names a temporary file
    else:
        note_losses(target)
    if options.output is not None:
        inputs = (*inputs_of(base), *inputs_of(theirs))
        save_document(converted(done.blueprint, target).document, target, made_of=inputs)
    else:
        save_document(done.blueprint.document, target, over)
    still = _still_open(done)
    _tell(done, still, named, out, options.format == "json")
    return 1 if still else 0


def _still_open(done: Merge) -> list[tuple[Conflict, str]]:
    """Return all open conflicts of the result with their words.

    First come the new ones, then those that an earlier merge left open. An entry that cannot be
    read counts, too, because the check reports it.
    """
    found, odd = read_conflicts(done.blueprint.document.values.get(KEY, []))
    strange = [(Conflict(path, ABSENT, ABSENT, ABSENT), words) for path, words in odd]
    return [*((one, one.words) for one in found.values()), *strange]


def _read(file: str, name: str | None) -> Blueprint:
    """Read one version. ``name`` says the form, and where the imported files are.

    An empty file is an empty blueprint: git gives one as the base of a file that both sides added.
    """
    if name is None or file == "-":
        return read_argument(file)
    raw = read_content(file).raw
    blueprint = read_bytes(raw, name) if raw.strip() else read_bytes(b"{}", "nothing.json")
    note_stand_ins(blueprint)
    return blueprint


def _tell(
    done: Merge, still: Sequence[tuple[Conflict, str]], target: str, out: Output, as_json: bool
) -> None:
    if as_json:
        out.json(
            {
                "conflicts": [one.as_json() for one, _ in still],
                "layout_kept": list(done.layout_kept),
            }
        )
        return
    for one, words in still:
        out.line(one_line(f"{one.address}: {words}"))
    number, before = len(still), len(still) - len(done.conflicts)
    if number:
        words = "1 conflict keeps" if number == 1 else f"{number} conflicts keep"
        stand = "stands" if number == 1 else "stand"
        note(f"{words} your version in {target}, and {stand} there under _conflicts.")
    if before:
        note(f"{before} of them {'was' if before == 1 else 'were'} open before this merge.")
    if not number:
        out.line(one_line(f"{target}: merged"))
    if done.layout_kept:
        note(f"The drawing of {len(done.layout_kept)} elements differs; yours is kept.")
