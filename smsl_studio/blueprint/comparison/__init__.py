"""What changed between two blueprints: meaning, and layout apart.

``compare`` reads both as graphs, not as texts: order, form, comments and written-out defaults make
no difference, a renamed state is one change and not one for every operation that leads to it.
"""

from smsl_studio.blueprint.comparison.compare import compare
from smsl_studio.blueprint.comparison.difference import Change, ChangeKind, Difference

__all__ = ["Change", "ChangeKind", "Difference", "compare"]
