"""The frame of the window: menus, bars, docks, tabs and status line."""
