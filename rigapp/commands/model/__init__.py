"""What ``rigapp model`` does on a terminal: the mechanism, one contact, a life, the paper."""
