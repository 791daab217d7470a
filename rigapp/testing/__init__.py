"""Test suite of the driver contract, for authors of drivers.

``plugin`` is the pytest plug-in, ``contracts`` reads the drivers under test and the faults that
they must report, ``bench`` connects a driver to its simulator by a wire with faults. The suite:

    pytest -p rigapp.testing.plugin --pyargs rigapp.testing --rigapp-contract contract.toml
"""

import pytest

pytest.register_assert_rewrite("rigapp.testing.bench")
