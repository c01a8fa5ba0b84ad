"""The mode Review: a procedure as text, line by line, for people who approve it."""
