"""The librarian's room: text to Document and back, spelling only, lossless."""
