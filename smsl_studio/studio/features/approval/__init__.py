"""Approval in the window: the badge that says who has signed the blueprint, and why that counts."""
