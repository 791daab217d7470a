"""``rigapp model``: mechanism, contact, wear life, the paper's comparisons."""
