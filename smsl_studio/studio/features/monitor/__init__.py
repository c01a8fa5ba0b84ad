"""The monitor page: every node, every sensor, every fact and every state check, as they are now."""
