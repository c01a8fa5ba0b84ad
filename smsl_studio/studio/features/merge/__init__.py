"""The page Merge of Draw: the open conflicts of a merge, chosen one by one."""
