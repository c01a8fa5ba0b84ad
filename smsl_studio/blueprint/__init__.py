"""The heart and only shared vocabulary: what is meant, as frozen values and pure functions."""
