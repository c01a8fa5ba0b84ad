"""The YAML form, in maps or in upstream's lists of maps: read and written whole.

The functions here are the doors of a form; see ``forms.Form``.
"""

from smsl_studio.smsl.yaml_form.reader import form_within, parse, recover
from smsl_studio.smsl.yaml_form.rewrite import comments_in, keep_winner, reconcile, tidy
from smsl_studio.smsl.yaml_form.writer import write

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
