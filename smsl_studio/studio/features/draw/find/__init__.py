"""The palette: places, findings, files and commands in one ranked list, found by typing."""
