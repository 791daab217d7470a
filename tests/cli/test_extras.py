"""Where the packages of an extra are missing, the sentence names the extra that brings them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE_S

CODE = """
import sys
for name in {missing!r}:
    sys.modules[name] = None
{code}
"""
VERB = "from rigapp.cli import main\nsys.argv[1:] = {arguments!r}\nmain()"
STUDY = Path(__file__).parents[2] / "examples" / "study.toml"


def without(missing: tuple[str, ...], code: str) -> subprocess.CompletedProcess[str]:
    """Run a few lines where these packages cannot be imported."""
    return subprocess.run(
        [sys.executable, "-c", CODE.format(missing=missing, code=code)],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("missing", "arguments", "extra"),
    [
        (("xarray",), ["study", str(STUDY), "--to", "made"], "studies"),
        (("distributed",), ["study", str(STUDY), "--to", "made"], "studies"),
        (("starlette",), ["page"], "page"),
    ],
)
def test_a_verb_names_the_extra(
    missing: tuple[str, ...],
    arguments: list[str],
    extra: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    done = without(missing, VERB.format(arguments=arguments))
    assert done.returncode == 2
    assert f"pip install 'rigapp[{extra}]'" in done.stderr
    assert missing[0] in done.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("call", ["open('t.h5')", "open_many('*.h5')"])
def test_opening_for_analysis_names_the_extra(call: str) -> None:
    done = without(("xarray",), f"import rigapp\nrigapp.{call}")
    assert "pip install 'rigapp[analysis]'" in done.stderr.splitlines()[-1]
