"""What every part of the window is made of: colours, controls, rows, words. No documents."""
