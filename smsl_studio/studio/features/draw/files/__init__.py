"""What is asked about files, and files that are dropped on the window."""
