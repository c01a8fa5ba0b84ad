"""How wide the names in compact nodes may be, so that neighbours have room for theirs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from smsl_studio.picture.levels import COMPACT_MAX, Floats, spacing_of
from smsl_studio.picture.picture import Face

STEPS = (COMPACT_MAX, 104.0, 84.0, 68.0)
"""The widths (pixels) that are tried for nodes with names, the widest first."""
WANTED = 0.5
"""The zoom from which all names should be readable."""


def with_room(at: Floats, full: Floats, compact: Floats, faces: Sequence[Face]) -> Floats:
    """Return the widths of compact nodes. In a dense drawing those of nodes with names are smaller.

    Without that such nodes would overlap when the drawing is small, and no name would be shown at
    all. A name that is shortened in its middle still tells states apart. ``at`` has the centres
    (n, 2), ``full`` and ``compact`` the wished widths of the nodes (n,).
    """
    names = np.array([face.short == face.name for face in faces], dtype=bool)
    found = compact
    for most in STEPS if names.any() else ():
        found = np.where(names, np.minimum(compact, most), compact)
        if spacing_of(at, full, found).compact_zoom <= WANTED:
            break
    return found
