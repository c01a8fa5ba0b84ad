"""Questions of shape: what is reachable, the cheapest way, where to draw.

The integer arrays inside are nobody else's business: questions and answers are in names and
addresses, never in a library's objects.
"""
