"""Which bundles of a collapsed picture are open: those of the selected state, and marked lines."""

from __future__ import annotations

from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.paint.looks import Looks


def opened(picture: Picture, looks: Looks) -> Picture:
    """Return the picture with the bundles that fit its marks; the same one if they did already.

    An operation with a mark of its own has a line of its own. So have all operations of the one
    selected state, and those that somebody has drawn by hand.
    """
    if not picture.collapsed:
        return picture
    alone = looks.own_lines | picture.edge_layouts().keys()
    bundles = picture.all_bundles.without(alone)
    return picture if bundles == picture.bundles else picture.bundled(bundles)
