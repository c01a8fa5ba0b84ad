"""The shell: the application, its windows, and the frame that the features are put into."""
