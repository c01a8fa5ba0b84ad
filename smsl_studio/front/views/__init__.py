"""What a run shows, as rows and words. The window and the command line draw or print them."""
