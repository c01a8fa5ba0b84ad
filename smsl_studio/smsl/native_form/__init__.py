"""The native form, ``.smsl``: State Branches in braces, header lines, states, edges. Lossless.

The functions here are the doors of a form; see ``forms.Form``.
"""

from smsl_studio.smsl.native_form.comments import comments_in
from smsl_studio.smsl.native_form.parsing import parse
from smsl_studio.smsl.native_form.recovery import recover
from smsl_studio.smsl.native_form.splicing import reconcile
from smsl_studio.smsl.native_form.tidying import tidy
from smsl_studio.smsl.native_form.winning import keep_winner
from smsl_studio.smsl.native_form.writing import write

__all__ = ["comments_in", "keep_winner", "parse", "reconcile", "recover", "tidy", "write"]
