"""The processes of the bench ``bombs``: the real program on one file, with its time and memory."""
