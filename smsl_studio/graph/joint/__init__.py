"""Joint spaces: the configurations of all SBs together, as sets and not one by one."""
