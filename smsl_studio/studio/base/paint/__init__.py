"""How states, operations and marks are painted, with nothing of a view around them."""
