"""Text to Document and back: spelling only, without any loss."""
