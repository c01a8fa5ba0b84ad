"""Other shapes of a blueprint with the same behaviour: computed, shown on both sides, applied."""
