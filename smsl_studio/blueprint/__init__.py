"""The blueprint: the vocabulary that all packages share, as frozen values and pure functions."""
