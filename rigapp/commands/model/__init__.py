"""``rigapp model``: the mechanism, one contact, a life, the paper."""
