"""``generate text``: a blueprint of expert text, with what each stage gave."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.output import Output, note
from smsl_studio.legible import one_line

if TYPE_CHECKING:
    from smsl_studio.front.generated_text import GeneratedText

OPTIONS = ("by_hand", "hardware", "provider", "require")
_SHOWN = 20


def add_text_arguments(parser: ArgumentParser) -> None:
    """Add the options of ``generate text``."""
    text = parser.add_argument_group("text")
    text.add_argument(
        "--by-hand", metavar="DIR", help="take the answers from DIR, and write prompts there"
    )
    text.add_argument("--hardware", metavar="FILE", help="a list of the hardware that is there")
    text.add_argument(
        "--provider",
        metavar="NAME",
        help="reader (no model), by-hand, replay:FILE, or the base URL of a server",
    )
    text.add_argument(
        "--require", metavar="FILE", help="what must be fulfilled (TOML); a verdict for each"
    )


def generate_of_text(options: argparse.Namespace, out: Output) -> int:
    """Generate. 0: the blueprint is written and its goal can be reached; 1: a stage has no answer,
    the goal cannot be reached, or a requirement is not fulfilled."""
    from smsl_studio.front.chain_files import PEOPLE
    from smsl_studio.front.generated_text import generate_text

    made = generate_text(
        options.files,
        options.output,
        provider=options.provider,
        by_hand=options.by_hand,
        hardware=options.hardware,
        require=options.require,
    )
    for sentence in made.left_out:
        note(one_line(f"left out: {sentence}"))
    for sentence, advice in made.lacking:
        note(one_line(sentence))
        if advice:
            note(one_line(advice))
    if options.format == "json":
        out.json(_as_json(made))
    elif made.blueprint is not None:
        states, operations = _counts(made)
        out.line(one_line(f"{options.output}: {states:,} states, {operations:,} operations"))
        for name in made.missing[:_SHOWN]:
            out.line(one_line(f"missing hardware: {name}"))
        for one in made.requirements:
            out.line(one_line(f"{one.verdict}: {one.kind} {one.name}: {one.reason}"))
        for words in made.doubts:
            out.line(one_line(f"look again: {words}"))
        for address in made.uncited[:_SHOWN]:
            out.line(one_line(f"no source: {address}"))
    if made.former:
        note(one_line(f"what stood there before and differs is in {made.former}"))
    if made.blueprint is None and Path(options.output).is_file():
        note(f"{options.output} is of an earlier call")
    if made.blueprint is not None and not made.goal_reached:
        note("the goal cannot be reached")
    if made.functions:
        output = Path(options.output)
        whole = output.is_dir() or not output.suffix
        rmm = (output if whole else output.parent) / "rmm"
        many = len(made.functions)
        what = "1 operation has" if many == 1 else f"{many:,} operations have"
        note(f"{what} no function; what there is waits in {rmm}")
        note(f"To read it: smsl-studio plugins allow {rmm}")
    if made.people:
        note(f"people are asked; {PEOPLE} answers for them in a trial: run --script {PEOPLE}")
    return 0 if made.is_good else 1


def _counts(made: GeneratedText) -> tuple[int, int]:
    branches = list(made.blueprint or ())
    return sum(len(one.table) for one in branches), sum(one.edge_count for one in branches)


def _as_json(made: GeneratedText) -> dict[str, object]:
    states, operations = _counts(made)
    return {
        "states": states,
        "operations": operations,
        "goal": made.goal_reached,
        "files": list(made.files),
        "functions": list(made.functions),
        "missing": list(made.missing),
        "uncited": list(made.uncited),
        "left_out": list(made.left_out),
        "doubts": list(made.doubts),
        "requirements": [one.as_json() for one in made.requirements],
        "lacking": [sentence for sentence, _ in made.lacking],
    }
