"""The changes between two blueprints: those of meaning, and those of the layout.

``compare`` reads both as graphs and not as texts. Order, form, comments and explicit defaults make
no difference. A renamed state is one change, whatever number of operations lead to it.
"""

from smsl_studio.blueprint.comparison.compare import compare
from smsl_studio.blueprint.comparison.difference import Change, ChangeKind, Difference

__all__ = ["Change", "ChangeKind", "Difference", "compare"]
