"""Other shapes of a blueprint with the same behaviour: a part as a sub-SB, or back again."""
