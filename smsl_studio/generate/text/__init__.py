"""From expert text to a blueprint: the paper's PM, HIM, PSM and RMM, with answers that are data."""
