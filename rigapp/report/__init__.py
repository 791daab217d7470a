"""Reports, certificates and the paper's figures."""
