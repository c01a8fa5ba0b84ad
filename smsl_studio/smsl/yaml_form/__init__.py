"""The YAML form, as maps or as upstream's lists of maps. A text is read and written as a whole.

The functions are those of ``forms.Form``.
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
