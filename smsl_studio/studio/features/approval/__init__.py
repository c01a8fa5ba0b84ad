"""The feature Approval: a badge that says who has signed the blueprint, and whether that counts."""
