"""The order of events that a log can have. An automaton checks the events one by one."""
