"""``campaign``: runs a blueprint many times, with seeds and faults. The exit status is 0 if every
run without a fault reached the goal."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.cli.arguments import (
    ArgumentParser,
    add_format,
    add_places,
    add_robot,
    add_supervisor,
    add_world,
)
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.errors import UsageError
from smsl_studio.legible import one_line
from smsl_studio.stop import look_for_garbage

if TYPE_CHECKING:
    from smsl_studio.front.campaigns import Campaign, CampaignRow


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``campaign``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint")
    add_world(parser, required=True)
    add_robot(parser)
    add_places(parser)
    add_supervisor(parser)
    parser.add_argument(
        "--seeds", type=_count, required=True, metavar="N", help="the seeds 0 to N-1"
    )
    parser.add_argument(
        "--faults", metavar="LIST|all", help="inject each of these faults in each edge, once"
    )
    parser.add_argument(
        "--edges",
        choices=("route", "all"),
        default="route",
        help="inject in the edges of the run without a fault (default), or in all of the blueprint",
    )
    parser.add_argument(
        "--workers", type=_count, default=1, metavar="N", help="so many processes (default 1)"
    )
    parser.add_argument(
        "--dask",
        default="",
        metavar="ADDRESS",
        help="a Dask scheduler, whose workers carry the runs out: tcp://HOST:PORT",
    )
    parser.add_argument(
        "--resume", action="store_true", help="take over what OUT.json.part has already"
    )
    parser.add_argument(
        "--until", type=_width, metavar="WIDTH", help="end when each interval is so narrow"
    )
    parser.add_argument("--report", metavar="OUT.html", help="write a page with the table, too")
    parser.add_argument(
        "--parquet", metavar="OUT.parquet", help="write the rows as Apache Parquet, too"
    )
    parser.add_argument(
        "-o", "--output", required=True, metavar="OUT.json", help="the result, OUT.json"
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Run the campaign, write its result, and print it. 0: all runs without a fault reached the
    goal, or there were faults and no row without them; 1: some did not."""
    from smsl_studio.front.campaign_faults import CampaignRequest
    from smsl_studio.front.campaign_page import campaign_page
    from smsl_studio.front.campaign_parquet import as_parquet, require_parquet
    from smsl_studio.front.campaigns import campaign
    from smsl_studio.smsl.files import save_document

    blueprint = read_argument(options.file)
    read = [one.file for one in blueprint.documents]
    look_for_garbage()
    output = Path(options.output)
    part = output.with_name(f"{output.name}.part") if output.name else output
    _check_outputs(options, output, part)
    if options.parquet is not None:
        require_parquet()
    if part.exists() and not options.resume:
        note(f"{part} of an earlier campaign is not taken over; --resume would do that")
        part.unlink()
    names = tuple(name.strip() for name in (options.faults or "").split(",") if name.strip())
    if options.faults is not None and not names:
        raise UsageError("--faults names no fault", advice="Name some, or all.")
    request = CampaignRequest(
        blueprint,
        options.world,
        seeds=options.seeds,
        faults=names,
        edges=options.edges,
        workers=options.workers,
        until=options.until,
        part=part,
        resume=options.resume,
        robot=options.robot,
        dask=options.dask,
        starts=tuple(options.start),
        goals=tuple(options.goal),
        agents=tuple(options.supervisor),
    )
    done = campaign(request, _progress)
    told = f"{json.dumps(done.as_json(), indent=1)}\n".encode("ascii")
    save_document(told, output, made_of=read)
    if options.report is not None:
        save_document(campaign_page(request, done).encode("utf-8"), options.report, made_of=read)
    if options.parquet is not None:
        save_document(as_parquet(done), options.parquet, made_of=read)
    part.unlink(missing_ok=True)
    for name in done.left_out:
        note(f"the fault {name} is left out: its parameters are not those of an operation")
    if done.made:
        note(
            f"{done.made:,} of {done.runs:,} runs differ from another one in their seed alone, and "
            "were not carried out; each hundredth was"
        )
    if done.alone:
        note(f"runs were carried out one by one: {done.alone}")
    if options.format == "json":
        out.json(done.as_json())
    else:
        _print(done, out)
    return 0 if all(row.held == 0 for row in done.rows if row.fault is None) else 1


def _check_outputs(options: argparse.Namespace, output: Path, part: Path) -> None:
    """Raise UsageError if a file that would be written is an input, or another output."""
    more = [Path(one) for one in (options.report, options.parquet) if one is not None]
    written = [output, part, *more]
    for one in written:
        if one.name in ("", "-") or one.is_dir():
            raise UsageError(f"{one} cannot be written: it is no file", advice="Name a file.")
    if part.is_symlink() or (part.exists() and not part.is_file()):
        raise UsageError(f"{part} is no ordinary file", advice="Remove it, or name another -o.")
    places = [one.resolve() for one in (*written, Path(options.file))]
    if len(set(places)) < len(places):
        raise UsageError(
            "a campaign would write over its blueprint, or one file over the other",
            advice="Name other files with -o, --report and --parquet.",
        )


def _print(done: Campaign, out: Output) -> None:
    for row in done.rows:
        out.line(one_line(line_of_row(row)))
    out.line(f"{done.reached:,} of {done.runs:,} runs reached the goal; digest {done.digest}")


def line_of_row(row: CampaignRow) -> str:
    """Return one row in words."""
    what = f"{row.fault} in {row.edge}" if row.fault else "without a fault"
    share = f"{100 * row.low:.1f} to {100 * row.high:.1f} %"
    recovered = f", {row.recovered} of them recovered" if row.recovered else ""
    return f"{what}: {row.reached} of {row.runs} reached the goal ({share}){recovered}"


def _progress(done: int, every: int) -> None:
    """Show on a terminal how many runs are done."""
    if sys.stderr.isatty():
        end = "\n" if done == every else ""
        sys.stderr.write(f"\r{done:,} of {every:,} runs{end}")
        sys.stderr.flush()


def _count(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and 0 < len(text) < 8 and int(text)):
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number from 1 to 9,999,999")
    return int(text)


def _width(text: str) -> float:
    try:
        found = float(text)
    except ValueError:
        found = 0.0
    if not 0.0 < found < 1.0:
        raise argparse.ArgumentTypeError(f"{text!r} is no width between 0 and 1")
    return found
