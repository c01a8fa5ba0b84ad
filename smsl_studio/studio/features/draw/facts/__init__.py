"""The table of facts beside the library: what each digit is, what its values mean, who reads it."""
