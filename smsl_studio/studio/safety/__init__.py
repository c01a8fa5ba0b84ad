"""Working without fear: journal, other programs, crashes."""
