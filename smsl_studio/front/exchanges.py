"""Blueprints to and from the forms of other programs."""

from __future__ import annotations

import os
from typing import NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError
from smsl_studio.exchange.carried import blueprint_of
from smsl_studio.exchange.findings import ExchangeFinding, ExchangeFindings
from smsl_studio.exchange.sources import foreign_values, is_foreign
from smsl_studio.exchange.table import WRITTEN, suffix_of, writer_of
from smsl_studio.smsl.forms import form_named

Name = str | os.PathLike[str]


class Exported(NamedTuple):
    """The text for another program, and what its form does not hold."""

    text: str
    findings: tuple[ExchangeFinding, ...]


class Imported(NamedTuple):
    """The blueprint that a file of another program shows, and what was left out."""

    blueprint: Blueprint
    findings: tuple[ExchangeFinding, ...]


def is_exported(output: Name) -> bool:
    """Whether the suffix of a file is that of another program."""
    return bool(suffix_of(os.fspath(output), WRITTEN))


def is_imported(file: Name) -> bool:
    """Whether a file or folder is one of another program, as its name says."""
    return is_foreign(os.fspath(file))


def exported(blueprint: Blueprint, output: Name) -> Exported:
    """Return a blueprint in the form of another program. No file is written.

    The suffix of ``output`` names the form (see ``docs/exchange.md``). UsageError if it is unknown,
    ConvertError if the form cannot hold the blueprint at all.

    >>> made = exported(read("hfsm.json"), "hfsm.scxml")
    >>> [one.kind for one in made.findings]
    ['subs']
    """
    suffix = suffix_of(os.fspath(output), WRITTEN)
    if not suffix:
        words = f"the suffix of {os.fspath(output)} is none of another program's form"
        raise UsageError(words, advice=f"End it with {', '.join(WRITTEN)}.")
    findings = ExchangeFindings()
    left = len(form_named(blueprint.document.form).comments_in(blueprint.document))
    if left:
        findings.add("comments", "", f"Comments of the text are left out ({left}).")
    return Exported(writer_of(suffix)(blueprint, findings), tuple(findings))


def imported(file: Name) -> Imported:
    """Return the blueprint that a file of another program shows.

    Nothing in it is run, and no file that it names is fetched. ReadError, with its place, if it
    cannot be read. UsageError for an unknown suffix.

    >>> convert(read("hfsm.json"), "hfsm.scxml").comments_left
    0
    >>> imported("hfsm.scxml").blueprint == read("hfsm.json")
    True
    """
    name, findings = os.fspath(file), ExchangeFindings()
    values = foreign_values(name, findings)
    return Imported(blueprint_of(values, name), tuple(findings))
