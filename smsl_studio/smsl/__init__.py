"""From text to Document and back. This room knows only spelling, and loses nothing."""
