"""Wrong files: every fault at once, each at its place and in the right words.

The files in ``bad/`` end in comments ``# fault LINE:COLUMN words``; the reader must
find exactly these.
"""

from __future__ import annotations

import random
import re
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from screwkit.errors import Fault, MechanismFileError
from screwkit.mechanism import yaml_nodes
from screwkit.mechanism.files import (
    LARGEST_FILE,
    mechanism_from_bytes,
    mechanism_from_text,
    read_mechanism,
)
from screwkit.mechanism.nodes import Faults, Node

HERE = Path(__file__).parent
BAD = sorted((HERE / "bad").glob("*.yaml"))
FOUR_BAR = (HERE / "four_bar.yaml").read_text(encoding="utf-8")
_EXPECTED = re.compile(r"^# fault (\d+):(\d+) (.*)$", re.MULTILINE)


def test_there_are_bad_files() -> None:
    assert len(BAD) >= 5


@pytest.mark.parametrize("path", BAD, ids=lambda path: path.stem)
def test_all_faults_at_once_and_in_order(path: Path) -> None:
    expected = _EXPECTED.findall(path.read_text(encoding="utf-8"))
    with pytest.raises(MechanismFileError) as caught:
        read_mechanism(path)
    found = caught.value.faults
    places = [(fault.line, fault.column) for fault in found]
    assert places == [(int(line), int(column)) for line, column, _ in expected], (
        f"\n{caught.value}"
    )
    for fault, (_, _, words) in zip(found, expected, strict=True):
        assert words in fault.message
    assert str(caught.value).count("\n") == len(found) - 1


def test_the_four_bar_itself_is_right() -> None:
    assert mechanism_from_text(FOUR_BAR, "four_bar.yaml").actuated == ("A",)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("name: C", "name: §B", "of this name stands in line 11 already"),
        ("[base, crank,", "[base, crank, §crank,", "'crank' stands twice"),
        ("child: base", "child: §ground", "joint 'D', child: unknown link 'ground'"),
        (
            "[0, 0, 1], point: [4",
            "§[0, 0, 0], point: [4",
            "'C', axis: the axis is zero",
        ),
        (
            "[0, 0, 1], point: [4",
            "§[0, sin(pi), sqrt(2) - sqrt(2)], point: [4",
            "joint 'C', axis: the axis is zero",
        ),
        ("child: rocker", "child: §coupler", "connects 'coupler' to itself"),
        ("C, type: revolute", "C, type: §Q", "type: unknown 'Q'; allowed:"),
        (
            "C, type: revolute",
            "C, type: §s",
            r"unknown 's' \(did you mean 'spherical'\?\)",
        ),
        ("base: base", "base: §chassis", "base: unknown link 'chassis'"),
        ("platform: rocker", "platform: §base", "are the same link"),
        (
            "{name: C, type: revolute, parent: coupler, child: rocker, axis: [0, 0, 1]",
            "§{name: C, type: revolute, parent: coupler, child: rocker",
            "joint 'C': the key 'axis' is missing; a revolute joint needs it",
        ),
        ("point: [4, 3, 0]", "point: §[4, 3]", "three coordinates, but 2"),
        ("geometry: posture", "geometry: §mhd", r"\(did you mean 'mdh'\?\)"),
        ("geometry: posture", "geometry:§", "unknown ''"),
        ("actuated: true", "actuated: [0, §0]", "freedom 0 stands twice"),
        ("actuated: true", "actuated: [§1]", "only freedom 0"),
        ("actuated: true", "actuated: §on", "true, false or a list"),
        (
            "actuated: true",
            "variable: §[u, v]",
            "revolute joint has 1 variable, not 2",
        ),
        ("actuated: true", "variable: §cos", "'cos' is a function"),
        ("actuated: true", "offset: §[1, 1]", "2 offsets for 1 freedom$"),
        ("actuated: true", "mdh: §{d: 1}", "belongs to `geometry: mdh`"),
        ("title: Planar", r'title: §"\uD800" #', "half of a character stands here"),
        ("title: Planar", "§titel: Planar", r"\(did you mean 'title'\?\)"),
        ("[1, 2, 0]", "[1, 2, 0.§.1]", "missing between '0.'"),
        ("[1, 2, 0]", '[1, "2 + §zz", 0]', "unknown name 'zz'"),
        ("[1, 2, 0]", "[1, '§zz', 0]", "under `parameters` or `variables`$"),
        ("[1, 2, 0]", "[1, §inf, 0]", "unknown name 'inf'; every number is finite$"),
        ("[1, 2, 0]", "[§NaN, 2, 0]", "unknown name 'NaN'; every number is finite$"),
        (
            "[1, 2, 0]",
            "[1, 30*§deg, 0]",
            "unknown name 'deg'; angles are in radians: 30 degrees are pi/6$",
        ),
        ("[1, 2, 0]", "[1, 2 + §sni(1), 0]", r"function 'sni' \(did you mean 'sin'"),
        ("[1, 2, 0]", "§P", r"unknown name 'P'.* one of the `points` or `vectors`$"),
        ("screwkit: 1", "screwkit: §7", "format version '7' is not known"),
        ("screwkit: 1\n", "§", "start the file with `screwkit: 1`"),
        ("[1, 2, 0]", '§[1, "", 0]', "an expression for y is expected, but nothing"),
        ("[1, 2, 0]", "§[1, 2, [3]]", "an expression for z is expected, but a list"),
        ("[1, 2, 0]", "§[1]", "three coordinates, but one was found"),
        ("[1, 2, 0]", '"P + §[1, 0, 0]"', "name the vector, u: .x, y, z., and write P"),
        ("[1, 2, 0]", "P + §[1, 0, 0]", "name the vector, u: .x, y, z., and write P"),
        ("axis: [0, 0, 1], point: [4", "axis: §z, point: [4", "'z'; write .0, 0, 1.$"),
        (
            "actuated: true",
            "§pitch: 1",
            "'pitch': it belongs to helical joints; all",
        ),
        (
            "type: revolute, parent: coupler, child: rocker, axis: [0, 0, 1]",
            "type: universal, parent: coupler, child: rocker, axes: §[[0, 0, 1]]",
            "two entries are expected, but one was found",
        ),
        ("links: [base, crank, coupler, rocker]", "links: §[]", "no body is listed"),
        ("child: rocker", "child: §*rocker", "aliases are not allowed"),
        ("[1, 2, 0]", "[§*one, 2, 0]", "aliases are not allowed"),
        ("[1, 2, 0]", "§*one", "aliases are not allowed"),
        ("base: base", "base: §!!int 3", "tags are not allowed"),
    ],
)
def test_one_change(old: str, new: str, message: str) -> None:
    assert FOUR_BAR.count(old) == 1
    marked = FOUR_BAR.replace(old, new)
    before, _, after = marked.partition("§")
    line = before.count("\n") + 1
    column = len(before) - (before.rfind("\n") + 1) + 1
    with pytest.raises(MechanismFileError, match=message) as caught:
        mechanism_from_text(before + after, "four_bar.yaml")
    (fault,) = caught.value.faults
    assert (fault.line, fault.column) == (line, column)
    assert str(caught.value).startswith(f"four_bar.yaml:{fault.line}:{fault.column}  ")


def test_a_variable_of_another_joint() -> None:
    text = FOUR_BAR.replace("actuated: true", "variable: qB")
    with pytest.raises(MechanismFileError, match=r"yaml:11:5 .*belongs to joint 'A'"):
        mechanism_from_text(text, "four.yaml")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "bad:1:1  the file is empty"),
        (b"# only a comment\n", "the file is empty"),
        (b"---\n", "bad:1:1  the file is empty"),
        (b"- a\n- b\n", "1:1  a mechanism file is a mapping .* this is a list"),
        (b"hello", "this is plain text"),
        (b"\n\x89PNG\x00\x01", "bad:2:5  this is a binary file"),
        (b"screwkit: 1\nname: caf\xe9\n", "bad:2:10  not UTF-8 text"),
        (b"screwkit: 1\nname: a\x07b\n", "bad:2:8  a character that is not printable"),
        (b"screwkit: 1\n\tname: a\n", "bad:2:1  a tab stands where spaces"),
        (b"screwkit: [1\n", "bad:2:1  not readable as YAML"),
        (b"screwkit: 1\n---\nscrewkit: 1\n", "bad:2:1  a second document"),
        (b"? [a, b]\n: 1\n", "bad:1:3  a key is text"),
        (b"[" * 5_000, "bad:1:51  nested deeper than 50 levels"),
        (b"{a: " * 60 + b"1" + b"}" * 60, "nested deeper than 50 levels"),
        (b"x" * (LARGEST_FILE + 1), "larger than 4000000 bytes"),
        (b"a: &a [x]\nb: &b [*a, *a]\nc: [*b, *b]\n", "aliases are not allowed"),
        (b"<<: {screwkit: 1}\n", "unknown key '<<'"),
        (
            b"!!python/object/apply:os.system ['true']\n",
            r"^bad.*tags are not allowed[^\n]*$",
        ),
        (
            b"screwkit: []\n",
            "the version of the format, `screwkit: 1`, is expected, but a",
        ),
    ],
)
def test_hopeless_files(content: bytes, message: str) -> None:
    start = time.perf_counter()
    with pytest.raises(MechanismFileError, match=message):
        mechanism_from_bytes(content, "bad")
    assert time.perf_counter() - start < 2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "bad:1:1  not readable as JSON"),
        ('{"screwkit": 1,}', "bad:1:1[56]  not readable as JSON"),
        ("\n" + "[" * 100_000, "bad:2:52  nested deeper than 50 levels"),
        ('{"screwkit": 1,\n "name": null}', "bad:2:10  null is not allowed"),
        ('{"screwkit": 1,\n "screwkit": 1}', "bad:2:2  the key 'screwkit' stands"),
        ('{"screwkit": 2}', "bad:1:14  screwkit: format version '2' is not known"),
        ("[]", "this is a list"),
        (r'{"screwkit": 1, "a\udfff": 1}', "bad:1:17  half of a character"),
        ('"x"', "this is plain text"),
        ("NaN", "this is plain text"),
    ],
)
def test_hopeless_json(text: str, message: str) -> None:
    with pytest.raises(MechanismFileError, match=message):
        mechanism_from_text(text, "bad", json=True)


def test_paths_that_are_no_files(tmp_path: Path) -> None:
    with pytest.raises(MechanismFileError, match="this is a directory"):
        read_mechanism(tmp_path)
    with pytest.raises(MechanismFileError, match="cannot be read: No such file"):
        read_mechanism(tmp_path / "none.yaml")
    with pytest.raises(MechanismFileError, match="cannot be read: no usable file name"):
        read_mechanism("a\0b")


def _cut(text: str, rule: Callable[[int], bool]) -> str:
    return "\n".join(s for i, s in enumerate(text.splitlines()) if rule(i))


@pytest.mark.parametrize("line", range(FOUR_BAR.count("\n")))
def test_no_missing_line_ends_in_a_traceback(line: int) -> None:
    with suppress(MechanismFileError):
        mechanism_from_text(_cut(FOUR_BAR, lambda i: i != line), "cut")


@pytest.mark.parametrize("length", range(0, len(FOUR_BAR), 7))
def test_no_truncation_ends_in_a_traceback(length: int) -> None:
    with suppress(MechanismFileError):
        mechanism_from_text(FOUR_BAR[:length], "cut")


_PIECES = [
    *("[", "]", "{", "}", ",", ":", "-", "\n", '"', "'", "(", ")", "*", "&", "!", "|"),
    *("", "0", "true", "null", "[]", "{}", "cross(", "mdh", "planar", "spherical", "#"),
]


@pytest.mark.parametrize("path", [*BAD, HERE / "four_bar.yaml"], ids=lambda p: p.stem)
def test_no_slip_of_the_pen_ends_in_a_traceback(path: Path) -> None:
    original = path.read_text(encoding="utf-8").split("# fault")[0]
    words = [match.span() for match in re.finditer(r"[\w.]+|\[[^\[\]]*\]", original)]
    chance = random.Random(path.stem)
    for _ in range(120):
        start, end = chance.choice(words)
        text = original[:start] + chance.choice(_PIECES) + original[end:]
        with suppress(MechanismFileError):
            mechanism_from_text(text, "slip")


def test_a_joint_whose_name_is_a_list() -> None:
    text = FOUR_BAR.replace("name: C", "name: []") + "limbs: {all: [A, C]}\n"
    with pytest.raises(
        MechanismFileError, match=r"12:12  .*name is expected, but a li"
    ):
        mechanism_from_text(text, "four_bar.yaml")


def test_vectors_that_double_again_and_again_are_refused() -> None:
    lines = ["vectors:", "  v0: [a, b, c]", "  w0: [b, c, a]"]
    for k in range(40):
        lines.append(f"  v{k + 1}: ['dot(v{k}, w{k})', 'dot(v{k}, v{k})', 1]")
        lines.append(f"  w{k + 1}: cross(v{k}, w{k})")
    text = FOUR_BAR + "\n".join(["parameters: {a: 1, b: 2, c: 3}", *lines, ""])
    start = time.perf_counter()
    with pytest.raises(MechanismFileError, match="products of vectors grow too large"):
        mechanism_from_text(text, "doubling")
    assert time.perf_counter() - start < 5


_SAMPLES = [
    FOUR_BAR,
    *(path.read_text(encoding="utf-8").split("# fault")[0] for path in BAD),
    "a: |\n  x\nb: >-\n  z\nc: 'it''s'\nd: \"x\\ty\"\ne: x\n  y\n",
    "a: [{b: , c}, d: e]\nf:\n- - g\n- ü: 😀 # h\n",
]


@pytest.mark.skipif(yaml_nodes._FAST is None, reason="PyYAML was built without libyaml")
@pytest.mark.parametrize("sample", _SAMPLES)
def test_both_parsers_of_yaml_read_the_same(
    sample: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    chance = random.Random(sample)
    texts = [sample]
    for _ in range(60):
        start = chance.randrange(len(sample))
        piece = chance.choice(_PIECES)
        texts.append(sample[:start] + piece + sample[start + chance.randrange(3) :])
    fast = [_tree_of(text) for text in texts]
    monkeypatch.setattr(yaml_nodes, "_FAST", None)
    assert fast == [_tree_of(text) for text in texts]


def _tree_of(text: str) -> tuple[Node | None, list[Fault]]:
    faults = Faults()
    return yaml_nodes.yaml_tree(text, faults), faults.found
