"""The measurements of `./dev bench`: ratios to peers and to the physical limit, taken side by
side."""
