"""The page Room: a plan of the room with its nodes, what each says, and what is silent."""
