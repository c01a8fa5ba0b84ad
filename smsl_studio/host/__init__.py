"""Hosts run the code of operations tick by tick, so that the dispatcher survives their faults."""
