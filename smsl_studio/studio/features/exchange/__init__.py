"""Files of other programs: import them, and export for them."""
