"""Configuration mistakes each get one sentence with file, key and remedy."""

from __future__ import annotations

import typing
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.config.calibration_settings import LoadCellFile, ProbeFile, RunOutFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import (
    parse_rig,
    parse_test,
    read_parameter_file,
    read_parameters,
    read_rig,
    read_test,
)
from rigapp.config.numbers import ANY
from rigapp.config.parameters import ParameterFile
from rigapp.config.ranges import keys_of
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.writing import whole_file

EXAMPLES = Path(__file__).parents[2] / "examples"


def example(name: str) -> str:
    return (EXAMPLES / name).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["quick.toml", "paper.toml", "steps.toml"])
def test_shipped_tests_are_readable(name: str) -> None:
    assert read_test(EXAMPLES / name).record.schema == 1


def test_shipped_rig_is_readable() -> None:
    rig = read_rig(EXAMPLES / "simulated.toml")
    assert rig.record.simulation is not None
    assert set(rig.record.devices) == {"daq", "drive"}


MISTAKES = [
    ("speed_rpm = 60.0", "speed_rps = 60.0", "run.speed_rps", "did you mean speed_rpm"),
    ("overload_N = 380.0", "overload_kN = 0.38", "limits.overload_kN", "did you mean overload_N"),
    ("revolutions = 500", "revolutions = 0", "run.revolutions", "outside 1 to"),
    ("revolutions = 500", 'revolutions = "500"', "run.revolutions", "an integer, got text"),
    ("[cycles]", "[cylces]", "cylces", "did you mean cycles"),
    ('schedule = "every"', 'schedule = "often"', "cycles.schedule", "every, logarithmic, none"),
    ('title = "Quick test"', "", "title", "is missing"),
    ("schema = 1\ntitle", "schema = 9\ntitle", "schema = 9", "newer"),
    ("[run]", "[run", "not valid TOML", "line"),
    ("crank_radius_mm = 76.2", "", "model.mechanism.crank_radius_mm", "is missing"),
    ("overspeed_rpm = 90.0", "overspeed_rpm = 50.0", "limits.overspeed_rpm", "not above"),
]


@pytest.mark.parametrize(("old", "new", "key", "remedy"), MISTAKES)
def test_mistake_in_a_test_file(old: str, new: str, key: str, remedy: str) -> None:
    text = example("quick.toml")
    assert old in text
    with pytest.raises(UnusableInput) as caught:
        parse_test(text.replace(old, new, 1), "my-test.toml")
    sentence = str(caught.value)
    assert sentence.startswith("my-test.toml: ")
    assert key in sentence
    assert remedy in sentence
    assert "\n" not in sentence


@pytest.mark.parametrize(
    ("old", "new", "needle"),
    [
        ('device = "daq"', 'device = "dax"', "not among the devices"),
        ("[simulation]\nseed = 1\nspeed = 20.0", "", "there is no [simulation]"),
        ('port = "simulated"', 'port = " "', "devices.daq.port is empty"),
        ("direction = 1", "direction = 2", "spindle.direction"),
    ],
)
def test_mistake_in_a_rig_file(old: str, new: str, needle: str) -> None:
    text = example("simulated.toml")
    assert old in text
    with pytest.raises(UnusableInput, match=needle.replace("[", r"\[").replace("]", r"\]")):
        parse_rig(text.replace(old, new, 1), "rig.toml")


@pytest.mark.parametrize(
    ("read", "name", "kinds"),
    [
        (read_rig, "paper.toml", ("test file", "rig file")),
        (read_test, "simulated.toml", ("rig file", "test file")),
        (read_parameter_file, "simulated.toml", ("rig file", "parameter file")),
    ],
)
def test_a_file_in_the_place_of_another_is_told(
    read: Callable[[Path], object], name: str, kinds: tuple[str, str]
) -> None:
    with pytest.raises(UnusableInput) as refused:
        read(EXAMPLES / name)
    given, wanted = kinds
    assert f"{name}: this is a {given}; a {wanted} belongs here" in str(refused.value)


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(UnusableInput, match=r"nothing\.toml: there is no such file"):
        read_test(tmp_path / "nothing.toml")


@given(st.text(max_size=200))
def test_any_text_is_refused_in_one_sentence(text: str) -> None:
    with pytest.raises(UnusableInput) as caught:
        parse_test(text, "any.toml")
    assert str(caught.value).startswith("any.toml: ")


FILES = [TestFile, RigFile, ParameterFile, LoadCellFile, ProbeFile, RunOutFile]


def parts(hint: object) -> Iterator[object]:
    yield hint
    if typing.get_origin(hint) is not typing.Literal:
        for part in typing.get_args(hint):
            yield from parts(part)


@pytest.mark.parametrize("kind", FILES)
def test_every_number_of_a_file_says_what_it_may_be(kind: type[msgspec.Struct]) -> None:
    numbers = [one for one in keys_of(kind) if {int, float} & {*parts(one.value_type)}]
    missing = {one.path for one in numbers if one.range is ANY}
    assert all(path.endswith("schema") for path in missing)
    for one in numbers:
        assert one.path in missing or one.range.integer == (int in parts(one.value_type)), one.path


@pytest.mark.parametrize("kind", FILES)
def test_what_says_a_range_is_a_number(kind: type[msgspec.Struct]) -> None:
    for one in keys_of(kind):
        assert one.range is ANY or {int, float} & {*parts(one.value_type)}, one.path


def test_a_byte_order_mark_does_not_matter(tmp_path: Path) -> None:
    path = tmp_path / "marked.toml"
    path.write_bytes(b"\xef\xbb\xbf" + example("quick.toml").replace("\n", "\r\n").encode())
    assert read_test(path).record == read_test(EXAMPLES / "quick.toml").record


@pytest.mark.parametrize(
    "text",
    [
        "a = " + "[" * 100_000 + "]" * 100_000,
        "a = " + "{a = " * 20_000 + "1" + "}" * 20_000,
        ".".join("a" * 100_000) + " = 1",
        "[" + " . ".join("a" * 100_000) + "]",
        "a = " + "[\n" * 100_000,
        '"' + "]" * 50 + '" = ' + "[" * 50 + '"' + "]" * 50 + '"',
    ],
)
def test_what_lies_too_deep_is_refused_before_it_is_parsed(text: str) -> None:
    with pytest.raises(UnusableInput, match=r"deep\.toml: nesting is .* deep"):
        parse_test("schema = 1\n" + text, "deep.toml")


def test_dots_and_brackets_in_a_text_are_not_depth() -> None:
    notes = f"{'[' * 40} {'...' * 40} # {'{' * 40}"
    line = f'operator = "{notes}"  # {notes}\nnotes = """\n{notes}"\n{notes}"""'
    test = parse_test(example("quick.toml").replace('operator = "first start"', line), "x.toml")
    assert test.metadata.operator == notes
    assert test.metadata.notes == f'{notes}"\n{notes}'


@pytest.mark.parametrize("text", ["a\\u0000b", "\\u001b[31mred", "bell \\u0007"])
def test_a_control_character_in_a_text_is_refused(text: str) -> None:
    changed = example("quick.toml").replace('"PTFE bushing 1"', f'"{text}"')
    with pytest.raises(UnusableInput, match=r"metadata\.specimen holds the control .* \\u00"):
        parse_test(changed, "x.toml")
    with pytest.raises(UnusableInput, match=r"^x.toml: name holds the control character"):
        parse_rig(example("simulated.toml").replace("Simulated slider-crank", text), "x.toml")


def rewritten(path: Path, text: str, *, new: bool = False, error: Exception | None = None) -> None:
    with whole_file(path, new=new) as part:
        part.write_text(text)
        if error is not None:
            raise error


def test_a_file_is_written_whole_or_not_at_all(tmp_path: Path) -> None:
    path, link = tmp_path / "a.toml", tmp_path / "link.toml"
    path.write_text("before")
    path.chmod(0o640)
    link.symlink_to(path)
    with pytest.raises(RuntimeError):
        rewritten(path, "half", error=RuntimeError())
    assert path.read_text() == "before"
    rewritten(link, "after")
    assert (path.read_text(), path.stat().st_mode & 0o777) == ("after", 0o640)
    assert link.is_symlink()
    with pytest.raises(UnusableInput, match=r"a\.toml: cannot be written"):
        rewritten(path, "again", new=True)
    assert path.read_text() == "after"
    assert sorted(one.name for one in tmp_path.iterdir()) == ["a.toml", "link.toml"]


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ('law = "archard"\npressure_exponent = 1.5', "wear.pressure_exponent has no effect"),
        ('law = "pressure-exponent"', "wear.pressure_exponent is missing"),
        ('law = "two-regime"', "two-regimes"),
        (
            'law = "running-in"\ninitial_wear_coefficient_mm3_per_Nm = 1e-4\n'
            "running_in_revolutions = 100.0",
            "is below bushing.wear_coefficient_mm3_per_Nm",
        ),
    ],
)
def test_a_wear_law_reads_its_keys_and_no_others(tmp_path: Path, section: str, words: str) -> None:
    path = tmp_path / "parameters.toml"
    text = (EXAMPLES / "parameters.toml").read_text(encoding="utf-8")
    path.write_text(f"{text}\n[wear]\n{section}\n", encoding="utf-8")
    with pytest.raises(UnusableInput, match=words):
        read_parameters(path)


def test_a_wear_law_becomes_the_models_in_si(tmp_path: Path) -> None:
    path = tmp_path / "parameters.toml"
    text = (EXAMPLES / "parameters.toml").read_text(encoding="utf-8")
    law = (
        'law = "two-regimes"\nsevere_wear_coefficient_mm3_per_Nm = 1.01e-3\n'
        "transition_MPa_m_per_s = 0.01"
    )
    path.write_text(f"{text}\n[wear]\n{law}\n", encoding="utf-8")
    found = read_parameters(path).bushing.law
    assert (found.name, found.transition) == ("two-regimes", pytest.approx(1e4))
    assert found.beyond == pytest.approx(2.0)
