"""The verbs for users: they connect the rooms of the package. ``smsl_studio`` exports their
functions, and the command line has a command for each.

A module is loaded at the first use of one of its names, so that ``import smsl_studio`` stays quick.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from smsl_studio.front.bundles import bundle
    from smsl_studio.front.campaign_faults import CampaignRequest
    from smsl_studio.front.campaigns import campaign
    from smsl_studio.front.examples import learn, learn_from_logs
    from smsl_studio.front.exchanges import exported, imported
    from smsl_studio.front.exploration import explore
    from smsl_studio.front.generated import generate_pddl, generate_rules
    from smsl_studio.front.generated_code import generate_code, generate_driver
    from smsl_studio.front.generated_text import generate_text
    from smsl_studio.front.git_drivers import git_setup
    from smsl_studio.front.graphs import from_multidigraph, multidigraph
    from smsl_studio.front.hosts import worlds
    from smsl_studio.front.inputs import inspect, read, refusals
    from smsl_studio.front.installed import allow_plugin, forbid_plugin, plugins
    from smsl_studio.front.key_ring import (
        export_key,
        import_key,
        list_keys,
        make_key,
        revoke_digest,
        revoke_key,
        sign_register,
    )
    from smsl_studio.front.logs import account, replay, verify
    from smsl_studio.front.outputs import (
        convert,
        converted,
        diff,
        digest,
        fmt,
        merge,
        render,
    )
    from smsl_studio.front.physics import generate_explore
    from smsl_studio.front.previews import preview
    from smsl_studio.front.proof import prove
    from smsl_studio.front.readings import reading
    from smsl_studio.front.recovery import recoverability
    from smsl_studio.front.reports import report
    from smsl_studio.front.request import RunRequest
    from smsl_studio.front.revocations import dependants_of
    from smsl_studio.front.routes import plan_route
    from smsl_studio.front.runs import Run, open_request, open_run, run, run_request
    from smsl_studio.front.script.lines import read_script
    from smsl_studio.front.served_worlds import serve
    from smsl_studio.front.shapes import diff_behaviour, extract, flatten, identify, inline
    from smsl_studio.front.signatures import ApprovalRequest, approve
    from smsl_studio.front.single_edge import try_edge
    from smsl_studio.front.sites.new_site import make_site
    from smsl_studio.front.sites.node_programs import open_nodes
    from smsl_studio.front.store_shelf import add_blueprint, find_stored, shown_stored
    from smsl_studio.front.suitable_worlds import worlds_for
    from smsl_studio.front.sweeps import sweep
    from smsl_studio.front.verdicts import verify_approval

__all__ = [
    "ApprovalRequest",
    "CampaignRequest",
    "Run",
    "RunRequest",
    "account",
    "add_blueprint",
    "allow_plugin",
    "approve",
    "bundle",
    "campaign",
    "convert",
    "converted",
    "dependants_of",
    "diff",
    "diff_behaviour",
    "digest",
    "explore",
    "export_key",
    "exported",
    "extract",
    "find_stored",
    "flatten",
    "fmt",
    "forbid_plugin",
    "from_multidigraph",
    "generate_code",
    "generate_driver",
    "generate_explore",
    "generate_pddl",
    "generate_rules",
    "generate_text",
    "git_setup",
    "identify",
    "import_key",
    "imported",
    "inline",
    "inspect",
    "learn",
    "learn_from_logs",
    "list_keys",
    "make_key",
    "make_site",
    "merge",
    "multidigraph",
    "open_nodes",
    "open_request",
    "open_run",
    "plan_route",
    "plugins",
    "preview",
    "prove",
    "read",
    "read_script",
    "reading",
    "recoverability",
    "refusals",
    "render",
    "replay",
    "report",
    "revoke_digest",
    "revoke_key",
    "run",
    "run_request",
    "serve",
    "shown_stored",
    "sign_register",
    "sweep",
    "try_edge",
    "verify",
    "verify_approval",
    "worlds",
    "worlds_for",
]


class Verb(NamedTuple):
    """What a verb does, in a line, and the functions of Python that do it."""

    words: str
    functions: tuple[str, ...]


VERBS = {
    "check": Verb(
        "inspect blueprints: every finding with its place",
        ("inspect", "prove", "recoverability"),
    ),
    "fmt": Verb("lay files out canonically, comments and _ fields kept", ("fmt",)),
    "convert": Verb(
        "write a blueprint in another form, or for other programs, or read theirs",
        ("convert", "exported", "imported"),
    ),
    "diff": Verb("compare two blueprints by what they mean; layout apart",
                 ("diff", "diff_behaviour")),
    "merge": Verb("merge two versions of a blueprint by what they mean", ("merge",)),
    "git-setup": Verb("let git compare and merge blueprints by what they mean", ("git_setup",)),
    "render": Verb("draw a picture of a blueprint: SVG, PNG or PDF", ("render",)),
    "report": Verb("tell a blueprint in sentences for people, as HTML or PDF",
                   ("report", "reading")),
    "digest": Verb("SHA-256 of what blueprints do, say and need", ("digest",)),
    "route": Verb("plan the cheapest route between two states", ("plan_route",)),
    "explore": Verb("all configurations of all SBs together: disagreements and traps",
                    ("explore",)),
    "flatten": Verb("write a blueprint as one SB that behaves alike", ("flatten",)),
    "extract": Verb("write a blueprint in which some states are a sub-SB", ("extract",)),
    "inline": Verb("write a blueprint in which a sub-SB and its base are one SB", ("inline",)),
    "identify": Verb("list the states that could be a sub-SB", ("identify",)),
    "run": Verb("run a blueprint in a world, headless", ("run",)),
    "sweep": Verb("run every single edge in a world and check where it leads", ("sweep",)),
    "preview": Verb("say what a simulated world predicts for one operation", ("preview",)),
    "campaign": Verb("run a blueprint many times, with seeds and faults", ("campaign",)),
    "generate": Verb("make a blueprint of rules, PDDL, physics or text, code of one, or a driver",
                     ("generate_rules", "generate_pddl", "generate_explore", "generate_text",
                      "generate_code", "generate_driver")),
    "learn": Verb("find rules that make a blueprint, and what does not fit them",
                  ("learn", "learn_from_logs")),
    "replay": Verb("tell a run again from its log, or verify the log",
                   ("replay", "verify", "account")),
    "keys": Verb("make, list, move and revoke the keys that sign",
                 ("list_keys", "make_key", "export_key", "import_key", "sign_register",
                  "revoke_key")),
    "approve": Verb("sign what the check says about a blueprint", ("approve",)),
    "verify": Verb("say whether a blueprint is approved, and why not", ("verify_approval",)),
    "store": Verb(
        "keep, find and revoke what was inspected, by content",
        ("add_blueprint", "find_stored", "shown_stored", "dependants_of", "revoke_digest"),
    ),
    "bundle": Verb("write evidence about runs that can be checked without this program",
                   ("bundle",)),
    "nodes": Verb("make a site of sensor nodes with certificates, or run its sample nodes",
                  ("make_site", "open_nodes")),
    "serve": Verb("serve a simulated world to a program elsewhere", ("serve",)),
    "worlds": Verb("list the worlds there are", ("worlds",)),
    "plugins": Verb("list the plugins there are; allow or forbid one",
                    ("plugins", "allow_plugin", "forbid_plugin")),
}  # fmt: skip
"""The verbs, in the order in which the help lists them. ``cli/<verb>.py`` has the arguments of
each, and ``docs/command-line.md`` has a row made from the row here."""

_HOMES = {
    "read": "inputs",
    "read_script": "script.lines",
    "reading": "readings",
    "report": "reports",
    "inspect": "inputs",
    "prove": "proof",
    "recoverability": "recovery",
    "refusals": "inputs",
    "plan_route": "routes",
    "explore": "exploration",
    "diff_behaviour": "shapes",
    "extract": "shapes",
    "flatten": "shapes",
    "identify": "shapes",
    "inline": "shapes",
    "from_multidigraph": "graphs",
    "multidigraph": "graphs",
    "Run": "runs",
    "RunRequest": "request",
    "open_request": "runs",
    "run_request": "runs",
    "run": "runs",
    "open_run": "runs",
    "serve": "served_worlds",
    "worlds": "hosts",
    "worlds_for": "suitable_worlds",
    "sweep": "sweeps",
    "try_edge": "single_edge",
    "preview": "previews",
    "generate_rules": "generated",
    "generate_code": "generated_code",
    "generate_driver": "generated_code",
    "generate_pddl": "generated",
    "generate_explore": "physics",
    "learn": "examples",
    "learn_from_logs": "examples",
    "generate_text": "generated_text",
    "CampaignRequest": "campaign_faults",
    "campaign": "campaigns",
    "bundle": "bundles",
    "account": "logs",
    "ApprovalRequest": "signatures",
    "approve": "signatures",
    "verify_approval": "verdicts",
    "list_keys": "key_ring",
    "make_key": "key_ring",
    "make_site": "sites.new_site",
    "open_nodes": "sites.node_programs",
    "export_key": "key_ring",
    "import_key": "key_ring",
    "sign_register": "key_ring",
    "revoke_key": "key_ring",
    "revoke_digest": "key_ring",
    "add_blueprint": "store_shelf",
    "find_stored": "store_shelf",
    "shown_stored": "store_shelf",
    "dependants_of": "revocations",
    "replay": "logs",
    "verify": "logs",
    "convert": "outputs",
    "exported": "exchanges",
    "imported": "exchanges",
    "converted": "outputs",
    "diff": "outputs",
    "digest": "outputs",
    "fmt": "outputs",
    "git_setup": "git_drivers",
    "merge": "outputs",
    "render": "outputs",
    "allow_plugin": "installed",
    "forbid_plugin": "installed",
    "plugins": "installed",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
