"""The shell: the application, its windows, and the frame around the features."""
