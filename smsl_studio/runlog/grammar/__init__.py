"""Which stories a log can tell: an automaton of the run's events, beside the chain of its bytes."""
