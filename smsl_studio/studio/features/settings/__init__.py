"""The page of the settings: theme, size, motion, keys, saving, plugin folders, privacy."""
