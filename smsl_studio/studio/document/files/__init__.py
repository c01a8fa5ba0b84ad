"""Files: opened, saved, converted, and what of them stands on the disk."""
