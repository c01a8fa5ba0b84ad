"""The design cycle of a blueprint (paper, Fig. 2): its nine stages, from the text to the approval,
who made each, and what is out of date since an earlier one changed."""
