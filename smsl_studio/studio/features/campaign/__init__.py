"""The page Campaign of Run: many runs with seeds and faults, and what they say."""
