"""What a window can do, a folder for each. A feature does not know its neighbours."""
