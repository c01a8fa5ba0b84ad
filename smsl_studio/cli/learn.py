"""``learn``: writes rules that make a blueprint again, and tells which edges do not fit them."""

from __future__ import annotations

import argparse
from dataclasses import asdict

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.output import Output
from smsl_studio.errors import UsageError
from smsl_studio.smsl.files import save_document


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``learn``."""
    parser.add_argument(
        "files", nargs="+", metavar="FILE",
        help="a blueprint (- is standard input), or logs of runs (.jsonl)",
    )  # fmt: skip
    parser.add_argument(
        "-o", "--output", required=True, metavar="RULES.toml", help="where the rules go, a .toml"
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write the rules, and print the exceptions as JSON. 0: the rules are written."""
    from smsl_studio.front.examples import learn, learn_from_logs

    logs = [one for one in options.files if one.lower().endswith(".jsonl")]
    if (logs and len(logs) < len(options.files)) or (not logs and len(options.files) > 1):
        raise UsageError(
            "rules are learnt from one blueprint, or from logs of runs",
            advice="Name one blueprint, or files that end with .jsonl.",
        )
    if logs:
        learnt, made_of = learn_from_logs(logs), list[str | int](logs)
    else:
        blueprint = read_argument(options.files[0])
        learnt, made_of = learn(blueprint), list(inputs_of(blueprint))
    save_document(learnt.text, options.output, made_of=made_of)
    out.json({"cases": learnt.cases, "exceptions": [asdict(one) for one in learnt.exceptions]})
    return 0
