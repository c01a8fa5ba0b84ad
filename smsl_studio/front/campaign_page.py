"""A campaign as one page of HTML: a summary, and a table of all rows. It has no script and no link
outside."""

from __future__ import annotations

from html import escape

from smsl_studio.front.campaign_faults import CampaignRequest
from smsl_studio.front.campaigns import Campaign, CampaignRow
from smsl_studio.legible import one_line

_STYLE = """\
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 60rem; padding: 0 1rem;
  color: #1d2433; background: #fff }
table { border-collapse: collapse; width: 100% }
th, td { text-align: left; padding: .3rem .6rem; border-bottom: 1px solid #d5d9e2 }
td.n { text-align: right; font-variant-numeric: tabular-nums }
tr.bad td { background: #fdeceb }
code { font-size: .85em; overflow-wrap: anywhere }
@media (prefers-color-scheme: dark) {
  body { color: #e4e7ee; background: #14171f } th, td { border-color: #343b4a }
  tr.bad td { background: #46201e } }"""


def campaign_page(request: CampaignRequest, done: Campaign) -> str:
    """Return the page of a campaign."""
    name = escape(one_line(request.blueprint.file))
    rows = "\n".join(map(_line, done.rows))
    head = "".join(
        f"<th>{word}</th>"
        for word in ("fault", "operation", "runs", "reached", "held", "recovered", "95 % interval")
    )
    return f"""\
<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><title>Campaign of {name}</title><style>{_STYLE}</style></head>
<body>
<h1>Campaign of {name}</h1>
<p>World {escape(request.world)}: {done.reached:,} of {done.runs:,} runs reached the goal. Not a
medical device.</p>
<table><thead><tr>{head}</tr></thead><tbody>
{rows}
</tbody></table>
<p>Digest of all runs: <code>{done.digest}</code></p>
</body>
</html>
"""


def _line(row: CampaignRow) -> str:
    words = (escape(one_line(text or "none")) for text in (row.fault, row.edge))
    cells = "".join(f"<td>{word}</td>" for word in words)
    numbers = (row.runs, row.reached, row.held, row.recovered)
    cells += "".join(f'<td class="n">{number:,}</td>' for number in numbers)
    cells += f'<td class="n">{100 * row.low:.1f} to {100 * row.high:.1f} %</td>'
    kind = ' class="bad"' if row.held else ""
    return f"<tr{kind}>{cells}</tr>"
