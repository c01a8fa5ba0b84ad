"""People at the window: who they are, what they are asked, and how far people lead."""
