"""The paper's Operation Library: names of operations and facts -> code that moves and senses."""
