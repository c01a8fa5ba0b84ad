"""The human-automation continuum: who does, senses, inspects and supervises (paper, section on it).

Levels are ``human``, ``shared`` and ``automatic``. An operation's comes from its actor, a fact's
from its aggregation, all of them may be declared in ``_levels`` of the file or set before a run.
"""

from __future__ import annotations

HUMAN, SHARED, AUTOMATIC = LEVELS = ("human", "shared", "automatic")
