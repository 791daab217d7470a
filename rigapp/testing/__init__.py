"""The contract that every driver keeps, as a suite of tests for whoever writes one.

``plugin`` is the plug-in for pytest, ``contracts`` reads which drivers are tried and which faults
they must tell, ``bench`` puts a driver in front of its simulator on a wire that can break. The
suite:

    pytest -p rigapp.testing.plugin --pyargs rigapp.testing --rigapp-contract contract.toml
"""

import pytest

pytest.register_assert_rewrite("rigapp.testing.bench")
