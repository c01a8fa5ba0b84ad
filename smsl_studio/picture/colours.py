"""The colours of the light, the dark and the high-contrast theme by name, as ``#RRGGBB``, for the
window and for files.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

Colours = Mapping[str, str]

_NAMES = (
    "win surf sunk canvas dot line line2 nl tx tx2 tx3 acc accs accl onacc ok oks bad bads "
    "unk unks risk risks edge dim slate onslate stop"
)
_LIGHT = (
    "F3F4F6 FFFFFF EDEFF2 F8F9FB DCE0E6 DFE3E8 C2C8D1 8791A1 161B22 465060 5F6979 "
    "2456C9 E7EEFC 9CB5EE FFFFFF 0B7357 E0F2EB B3291B FCE8E5 64548F EFEBF7 8A4F00 FBEED6 "
    "788293 C9CED6 465060 FFFFFF C4221A"
)
_DARK = (
    "12161C 191E26 0E1217 11151B 242B35 2A313C 434D5C 6D7889 E9EDF2 B5BECA 929CAB "
    "86AAFF 1D2A49 4565B0 0B1430 4FCB9C 12322A FF8A76 401F1B B9A8EC 2B2541 F0B34C 392A10 "
    "7E899A 3A434F B5BECA 12161C D5352A"
)
_CONTRAST = (
    "000000 000000 0B0B0B 000000 4A4A4A 8A8A8A B8B8B8 FFFFFF FFFFFF F2F2F2 DADADA "
    "FFD60A 332B00 C7A600 000000 5CF2B8 00331F FFA69A 3D0B05 D6C8FF 261A47 FFC56B 3A2500 "
    "FFFFFF 9A9A9A FFFFFF 000000 C4221A"
)


def _named(colours: str) -> Colours:
    pairs = zip(_NAMES.split(), colours.split(), strict=True)
    return MappingProxyType({name: f"#{colour}" for name, colour in pairs})


LIGHT, DARK, CONTRAST = _named(_LIGHT), _named(_DARK), _named(_CONTRAST)
"""docs/window.md explains what each colour is for."""
