"""Engines and pages for the tests of the page; all of them end with the test."""

from __future__ import annotations

import ipaddress
import shutil
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import NameOID
from page.doubles import TOKEN, OpenPage, ServedEngine

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def rig(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a rig file in a folder of its own, with the engines' own folder beside it."""
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    return Path(shutil.copy(EXAMPLES / "simulated.toml", tmp_path / "left.toml"))


@pytest.fixture
def ending() -> Iterator[ExitStack]:
    """Close at the end what was opened."""
    with ExitStack() as stack:
        yield stack


@pytest.fixture
def serve(ending: ExitStack) -> Callable[..., ServedEngine]:
    """Return what starts an engine for a rig file."""

    def start(*given: Path, **status: object) -> ServedEngine:
        engine = ServedEngine(*given, **status)
        ending.callback(engine.close)
        return engine

    return start


@pytest.fixture
def show(ending: ExitStack) -> Callable[..., OpenPage]:
    """Return what opens a page."""

    def start(*given: object) -> OpenPage:
        page = OpenPage(*given)  # type: ignore[arg-type]
        ending.callback(page.close)
        return page

    return start


@pytest.fixture
def token(tmp_path: Path) -> Path:
    path = tmp_path / "token"
    path.write_text(f"{TOKEN}\n")
    path.chmod(0o600)
    return path


@pytest.fixture
def pair(tmp_path: Path) -> tuple[Path, Path]:
    """Return a certificate for 127.0.0.1 and its key."""
    key = ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "rig")])
    now = datetime.now(UTC)
    made = (
        x509.CertificateBuilder()
        .subject_name(name)
        .issuer_name(name)
        .public_key(key.public_key())
        .serial_number(1)
        .not_valid_before(now - timedelta(days=1))
        .not_valid_after(now + timedelta(days=1))
        .add_extension(
            x509.SubjectAlternativeName([x509.IPAddress(ipaddress.ip_address("127.0.0.1"))]),
            critical=False,
        )
        .add_extension(x509.BasicConstraints(ca=True, path_length=None), critical=True)
        .sign(key, hashes.SHA256())
    )
    certificate, secret = tmp_path / "page.crt", tmp_path / "page.key"
    certificate.write_bytes(made.public_bytes(serialization.Encoding.PEM))
    secret.touch(mode=0o600)
    secret.write_bytes(
        key.private_bytes(
            serialization.Encoding.PEM,
            serialization.PrivateFormat.PKCS8,
            serialization.NoEncryption(),
        )
    )
    return certificate, secret
