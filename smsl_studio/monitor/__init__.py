"""C_fact and aggregation: samples become facts with age, quality and reason."""
