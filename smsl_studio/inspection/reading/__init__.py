"""The reading: a blueprint as sentences for people who have never seen a state machine."""
