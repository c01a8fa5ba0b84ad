"""Pictures of graphs without Qt."""
