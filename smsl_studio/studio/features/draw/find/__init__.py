"""Find anything by typing: places, findings, files and commands in one ranked list."""
