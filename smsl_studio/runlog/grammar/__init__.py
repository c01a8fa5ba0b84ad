"""Which sequences of events a log can have: an automaton that checks them one by one."""
