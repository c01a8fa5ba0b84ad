"""People in the loop: what they are asked, who may answer, and what their answer does."""
