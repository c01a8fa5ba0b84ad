"""The frame of the window: menus, bars, docks, tabs, and what they say."""
