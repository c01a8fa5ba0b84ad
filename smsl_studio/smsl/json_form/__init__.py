"""The JSON form, ``{SB: {"HEADER": {...}, STATE: {OPERATION: TARGET}}}``: lossless.

The functions here are the doors of a form; see ``forms.Form``.
"""

from smsl_studio.smsl.json_form.reading import parse, recover, write
from smsl_studio.smsl.json_form.splicing import keep_winner, reconcile
from smsl_studio.smsl.json_form.tidying import tidy

parse_json, write_json = parse, write
"""The names under which those call them who want this form and no other."""

__all__ = [
    "keep_winner",
    "parse",
    "parse_json",
    "reconcile",
    "recover",
    "tidy",
    "write",
    "write_json",
]
