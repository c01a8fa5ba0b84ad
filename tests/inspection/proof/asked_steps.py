"""How often a search asks for the steps out of a configuration."""

from __future__ import annotations

import pytest

from smsl_studio.inspection.proof.space import Key, Space, Step


def asked_steps(patch: pytest.MonkeyPatch) -> list[Key]:
    """The configurations whose steps are asked for from now on, each time."""
    asked: list[Key] = []
    steps = Space.steps

    def noted(space: Space, key: Key) -> list[Step]:
        asked.append(key)
        return steps(space, key)

    patch.setattr(Space, "steps", noted)
    return asked
