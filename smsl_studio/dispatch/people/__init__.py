"""People in the loop: the tasks they are given, who may answer, and what became of them."""
