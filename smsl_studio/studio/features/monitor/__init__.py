"""The monitor page: all nodes, sensors, facts and state checks of a run, as they are now."""
