"""What people answer to the lines of a reading, before somebody signs."""
