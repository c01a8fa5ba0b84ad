"""The native form, ``.smsl``: State Branches in braces, header lines, states and edges.

It loses nothing of a text. The functions are those of ``forms.Form``.
"""

from smsl_studio.smsl.native_form.canonical import tidy
from smsl_studio.smsl.native_form.comments import comments_in
from smsl_studio.smsl.native_form.parser import parse
from smsl_studio.smsl.native_form.recovery import recover
from smsl_studio.smsl.native_form.refusals import form_within
from smsl_studio.smsl.native_form.splice import reconcile
from smsl_studio.smsl.native_form.winner import keep_winner
from smsl_studio.smsl.native_form.writer import write

__all__ = [
    "comments_in",
    "form_within",
    "keep_winner",
    "parse",
    "reconcile",
    "recover",
    "tidy",
    "write",
]
