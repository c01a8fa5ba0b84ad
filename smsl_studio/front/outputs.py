"""Outputs of a blueprint: another written form, the canonical layout, digests, differences and
pictures."""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING

from smsl_studio.blueprint.comparison import Difference, compare
from smsl_studio.blueprint.digests import Digests, digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.relocation import relocated
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.exchange.table import WRITTEN
from smsl_studio.front.exchanges import exported, is_exported
from smsl_studio.smsl.conversion import Converted
from smsl_studio.smsl.conversion import convert as in_form
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.files import document_of, read_content, save_document
from smsl_studio.smsl.forms import SUFFIXES, form_named

if TYPE_CHECKING:
    from smsl_studio.blueprint.merge import Merge
    from smsl_studio.picture.colours import Colours
    from smsl_studio.picture.panel import SvgPanel

Name = str | os.PathLike[str]
PICTURES = (".svg", ".png", ".pdf")
THEMES = ("light", "dark")


def digest(blueprint: Blueprint) -> Digests:
    """Return the SHA-256 digests of a blueprint, which people can compare and sign.

    ``behaviour`` covers states, operations and headers. ``meaning`` covers the annotations.
    ``closure`` covers both, and all imported files. Spaces, the order of keys and the places of
    boxes change no digest.

    >>> digest(read("hanoi.json")).behaviour == digest(read("hanoi-corrected.json")).behaviour
    False
    """
    return digests(blueprint)


def diff(before: Blueprint, after: Blueprint) -> Difference:
    """Compare the meaning of two blueprints. ``changes`` is empty if they mean the same.

    >>> for change in diff(read("hanoi.json"), read("hanoi-corrected.json")).changes:
    ...     print(change.words)
    The operation Op_1c of SB1/State_cbb is now called Op_1b.
    The operation Op_2b of SB1/State_cbc is now called Op_2a.
    """
    from smsl_studio.picture.aligned import as_drawn

    return as_drawn(compare(before, after))


def merge(base: Blueprint, ours: Blueprint, theirs: Blueprint) -> Merge:
    """Merge two versions of a blueprint that both come from ``base``, by what they mean.

    What only one side changed is taken, and what both changed alike. For the rest the blueprint
    keeps ``ours``, ``conflicts`` lists it, and the key ``_conflicts`` of the file has it.

    >>> before, after = read("hanoi.json"), read("hanoi-corrected.json")
    >>> done = merge(before, before, after)
    >>> done.conflicts
    ()
    >>> done.blueprint == after
    True
    """
    from smsl_studio.blueprint.merge import merge as merged

    return merged(base, ours, theirs)


def converted(blueprint: Blueprint, output: Name) -> Converted:
    """Return a blueprint in the written form of the suffix of ``output``. No file is written.

    ``document.text`` is the text. ``comments_left`` is the number of comments that are lost because
    the form has no comments. Names of imported files become relative to the folder of ``output``.
    UsageError for an unknown suffix. ConvertError, with place and advice, if the form cannot
    express a part of the blueprint.

    >>> converted(read("hanoi.json"), "hanoi.smsl").document.form
    'smsl'
    """
    return in_form(relocated(blueprint.document, output), form_of(output), os.fspath(output))


def form_of(output: Name, others: Collection[str] = ()) -> str:
    """Return the file format for the suffix of a file. UsageError if the suffix is unknown.

    ``others`` are further suffixes that the caller accepts. The advice of the error lists them.
    """
    form = SUFFIXES.get(PurePath(output).suffix.lower())
    if form is None:
        raise UsageError(
            f"the suffix of {os.fspath(output)} names no written form",
            advice=f"End it with {', '.join((*SUFFIXES, *others))}.",
        )
    return form


def convert(blueprint: Blueprint, output: Name) -> Converted:
    """Write a blueprint in the form of the suffix of ``output`` (see ``converted``).

    The suffix of another program's form writes that (see ``exported``), and ``document`` is the
    one that was read. SaveError if the file cannot be written, or if the blueprint was read from
    this file.

    >>> convert(read("hfsm.json"), "hfsm.yaml").comments_left
    0
    >>> digest(read("hfsm.yaml")) == digest(read("hfsm.json"))
    True
    """
    if is_exported(output):
        save_document(exported(blueprint, output).text, output, made_of=_files(blueprint))
        return Converted(blueprint.document)
    form_of(output, WRITTEN)
    made = converted(blueprint, output)
    save_document(made.document, output, made_of=_files(blueprint))
    return made


def fmt(file: Name, check: bool = False) -> bool:
    """Write a file anew in the canonical layout. Return whether the file changes.

    With ``check`` no file is written. ReadError if the file has no blueprint, SaveError if it
    cannot be written.

    >>> fmt("hfsm.json")
    True
    >>> fmt("hfsm.json", check=True)
    False
    """
    content = read_content(file)
    document = document_of(content, os.fspath(file))
    read_blueprint(document)
    tidied = tidy(document)
    changed = tidied.text != document.text
    if changed and not check:
        save_document(tidied, file, content.seen)
    return changed


def tidy(document: Document) -> Document:
    """Return a document in the canonical layout of its form. No file is written."""
    return form_named(document.form).tidy(document)


def render(
    blueprint: Blueprint,
    output: Name,
    branches: Collection[str] = (),
    theme: str = "light",
    overview: bool = False,
    collapsed: bool = False,
) -> None:
    """Draw State Branches into an ``.svg``, ``.png`` or ``.pdf`` file. No display is needed.

    ``branches`` are the names of the SBs; empty means all. ``theme`` is ``light`` or ``dark``. With
    ``overview`` the picture is the map of all SBs, and ``branches`` must be empty. With
    ``collapsed`` operations between the same two states are one line with their number. Below each
    page stands whether people have signed the blueprint. UsageError for another suffix or theme, or
    if there is no SB. AddressError for an unknown SB. SaveError if the file cannot be written.

    >>> render(read("hfsm.json"), "hfsm.svg")
    >>> Path("hfsm.svg").read_text("utf-8")[:4]
    '<svg'
    """
    picture = drawn(blueprint, output, branches, theme, overview, collapsed)
    save_document(picture, output, made_of=_files(blueprint))


def drawn(
    blueprint: Blueprint,
    output: Name,
    branches: Collection[str] = (),
    theme: str = "light",
    overview: bool = False,
    collapsed: bool = False,
) -> bytes:
    """Return the bytes that ``render`` writes. It raises the same errors, except SaveError."""
    picture_form(output)
    if overview and branches:
        raise UsageError("the map shows all State Branches", advice="Leave --sb or --map out.")
    colours = colours_of(theme)
    if overview and collapsed:
        raise UsageError("the map shows no operations", advice="Leave --collapse or --map out.")
    if overview:
        panels = map_panels(blueprint, colours)
    else:
        panels = panels_of(blueprint, branches, colours, collapsed)
    from smsl_studio.front.approval_badge import approval_words

    foot = approval_words(blueprint).foot
    return picture_of(panels, title_of(blueprint), output, colours, foot)


def panels_of(
    blueprint: Blueprint, branches: Collection[str], colours: Colours, collapsed: bool = False
) -> list[SvgPanel]:
    """Return the panels of SBs, of all if none is named. UsageError if there is no SB."""
    from smsl_studio.picture.svg import draw_blueprint

    _must_have_branches(blueprint)
    chosen = [blueprint[name].name for name in branches or blueprint.branches]
    return draw_blueprint(blueprint, list(dict.fromkeys(chosen)), colours, collapsed)


def map_panels(blueprint: Blueprint, colours: Colours) -> list[SvgPanel]:
    """Return the map of all SBs as the only panel. UsageError if there is no SB."""
    from smsl_studio.picture.branch_map_svg import map_panel

    _must_have_branches(blueprint)
    return [map_panel(blueprint, colours)]


def colours_of(theme: str) -> Colours:
    """Return the colours of a theme. UsageError if there is none of this name."""
    from smsl_studio.picture.colours import DARK, LIGHT

    if theme not in THEMES:
        raise UsageError(f"there is no theme {theme!r}", advice=did_you_mean(theme, THEMES))
    return DARK if theme == "dark" else LIGHT


def _must_have_branches(blueprint: Blueprint) -> None:
    if not blueprint.branches:
        raise UsageError(
            f"{blueprint.file} has no State Branch to draw", advice="Name another file."
        )


def title_of(blueprint: Blueprint) -> str:
    """Return the title of a picture, which is read aloud: the name of the file without its folder,
    so that equal blueprints have equal pictures wherever they stand."""
    return PurePath(blueprint.file).name


def drawn_difference(difference: Difference, output: Name, collapsed: bool = False) -> bytes:
    """Return a picture of a comparison as bytes. It marks added, removed and changed elements.

    With ``collapsed``, unchanged operations between the same two states are one line.
    """
    from smsl_studio.picture.colours import LIGHT
    from smsl_studio.picture.compared import draw_difference

    title = f"{difference.before.file} -> {difference.after.file}"
    panels = draw_difference(difference, LIGHT, collapsed)
    return picture_of(panels, title, output, LIGHT)


def picture_form(output: Name) -> str:
    """Return the suffix of a picture's file. UsageError if it is no suffix of a picture."""
    suffix = PurePath(output).suffix.lower()
    if suffix not in PICTURES:
        raise UsageError(
            f"{os.fspath(output)!r} is no name of a picture",
            advice="Let it end in .svg, .png or .pdf.",
        )
    return suffix


def picture_of(
    panels: Sequence[SvgPanel], title: str, output: Name, colours: Colours, foot: str = ""
) -> bytes:
    """Return the bytes of a picture of several panels. A PDF has one panel on each page. Other
    pictures have one panel below another. ``foot`` is a line below each page."""
    apart = picture_form(output) == ".pdf"
    return picture_bytes(svg_pages(panels, title, colours, apart, foot), title, output)


def svg_pages(
    panels: Sequence[SvgPanel], title: str, colours: Colours, apart: bool, foot: str = ""
) -> list[str]:
    """Return panels as SVG: ``apart`` one on each page, else one below another on one page. Each
    page has the line ``foot``."""
    from smsl_studio.picture.svg import as_svg, one_below_another

    pages = panels if apart else [one_below_another(panels, colours)]
    return [as_svg(page, title, colours, foot) for page in pages]


def picture_bytes(svgs: Sequence[str], title: str, output: Name, scale: float = 2.0) -> bytes:
    """Return pages in the form that the suffix of a file names. Only a PDF has several, and only a
    PNG a ``scale``."""
    from smsl_studio.picture.paper import as_pdf, as_png

    form = picture_form(output)
    if form == ".pdf":
        return as_pdf(svgs, title)
    return as_png(svgs[0], title, scale) if form == ".png" else svgs[0].encode("utf-8")


def _files(blueprint: Blueprint) -> tuple[str, ...]:
    """Return the files that a blueprint was read from. No output may replace them."""
    return tuple(document.file for document in blueprint.documents)
