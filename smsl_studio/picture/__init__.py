"""Pictures of graphs, differences and runs as files, without Qt."""
