"""The start page, which stands in Draw mode as long as no file is open."""
