"""A recorded run in the window: shown again from its log alone, and nothing can be commanded."""
