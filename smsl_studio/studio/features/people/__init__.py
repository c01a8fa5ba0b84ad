"""People at the window: who they are, which tasks they get, and the levels of automation."""
