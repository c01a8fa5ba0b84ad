"""Rules from a blueprint or from logs of runs."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.generate.examples.learnt import Learnt, learnt_from
from smsl_studio.generate.examples.logged import logged_examples
from smsl_studio.generate.examples.table import examples_of
from smsl_studio.runlog.grammar.log_reader import read_log

Name = str | os.PathLike[str]


def learn(blueprint: Blueprint) -> Learnt:
    """Return rules that make a blueprint, and its edges that do not fit them.

    PlanningError if the rules would have no fewer cases than the blueprint has operations, if it
    has several SBs, or if its states have no facts that rules could change.

    >>> learnt = learn(read("hanoi.json"))
    >>> learnt.cases, [one.address for one in learnt.exceptions if one.kind == "odd"]
    (3, ['SB1/State_cbb/Op_1c', 'SB1/State_cbc/Op_2b'])
    """
    return learnt_from(examples_of(blueprint))


def learn_from_logs(logs: Sequence[Name]) -> Learnt:
    """Return rules for what was committed in some runs. ReadError if a file is no log.

    >>> words = {"goal": "State_ccc", "log": "solved.jsonl"}
    >>> _ = run(read("hanoi-corrected.json"), **words)
    >>> learn_from_logs(["solved.jsonl"]).cases
    2
    """
    runs = [read_log(Path(log), COMMANDS) for log in logs]
    return learnt_from(logged_examples((run.header, run.events) for run in runs))
