"""The document of a window: its session, what is selected, and what an inspection finds in it."""
