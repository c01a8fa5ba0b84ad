"""The page Physics: a simulated world is tried out while one watches."""
