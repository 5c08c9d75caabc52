"""Text of the grammar cut into tokens, and refused where the tokens cannot fit.

Everything that the grammar does not know stops here, with its position: characters,
strings, attributes, missing operands, commas out of place, open parentheses.  What is
left is well formed, so that the parser behind has nothing to guess.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

from screwkit.algebra.names import shown
from screwkit.errors import ExpressionError

Kind: TypeAlias = Literal["number", "name", "operator", "open", "close", "comma"]

_TOKEN = re.compile(
    r"""(?P<space>[ \t\r\n]+)
      | (?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)
      | (?P<name>[A-Za-z_][A-Za-z0-9_]*)
      | (?P<operator>\*\*|[-+*/^])
      | (?P<open>\() | (?P<close>\)) | (?P<comma>,)""",
    re.VERBOSE,
)
_INSTEAD: Final = {
    "π": "pi",
    "−": "-",
    "–": "-",
    "·": "*",
    "⋅": "*",
    "×": "*",
    "÷": "/",
    "√": "sqrt(…)",
    "²": "^2",
    "³": "^3",
    "°": "angles in radians, pi/6 for 30 degrees",
    "{": "(",
    "}": ")",
}


@dataclass(frozen=True, slots=True)
class Token:
    """A piece of the text.

    Attributes:
        position: Offset of its first character, from 0.
    """

    kind: Kind
    text: str
    position: int


def tokens_of(text: str, depth: int) -> tuple[Token, ...]:
    """The tokens of ``text``, checked to stand where they may.

    Args:
        text: What a person wrote.
        depth: How deep parentheses, and how long runs of signs, may be.

    Raises:
        ExpressionError: At the first character or token that cannot stand there.
    """
    tokens = _cut(text)
    if not tokens:
        raise ExpressionError("an expression is expected, but nothing is written")
    _check_neighbours(tokens)
    _check_parentheses(tokens, depth)
    _check_signs(tokens, depth)
    return tokens


def names_in(text: str) -> tuple[tuple[str, int], ...]:
    """Every name in ``text`` with its position; nothing where it cannot be read."""
    try:
        tokens = _cut(text)
    except ExpressionError:
        return ()
    return tuple((t.text, t.position) for t in tokens if t.kind == "name")


def _cut(text: str) -> tuple[Token, ...]:
    tokens: list[Token] = []
    position = 0
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            raise _stranger(text[position], position)
        kind = match.lastgroup
        if kind != "space":
            tokens.append(Token(kind, match.group(), position))  # type: ignore[arg-type]
        position = match.end()
    return tuple(tokens)


def _stranger(character: str, position: int) -> ExpressionError:
    instead = _INSTEAD.get(character)
    hint = f"; write {instead}" if instead else ""
    if character in "[]":
        hint = (
            "; coordinates cannot stand in an expression: name the vector, "
            "u: [x, y, z], and write P + u"
        )
    return ExpressionError(
        f"the character {shown(character)} is not in the grammar{hint}", position
    )


def _check_neighbours(tokens: Sequence[Token]) -> None:
    previous: Token | None = None
    for token in tokens:
        _check_pair(previous, token)
        previous = token
    last = tokens[-1]
    if last.kind in {"operator", "comma"}:
        raise ExpressionError(f"nothing stands after {last.text!r}", last.position)


def _check_pair(previous: Token | None, token: Token) -> None:
    complete = previous is not None and previous.kind in {"number", "name", "close"}
    if token.kind in {"number", "name"} and complete:
        assert previous is not None
        raise ExpressionError(
            f"an operator is missing between {previous.text!r} and {token.text!r}",
            token.position,
        )
    if token.kind == "open" and complete:
        assert previous is not None
        if previous.kind != "name":
            raise ExpressionError(
                f"an operator is missing between {previous.text!r} and '('",
                token.position,
            )
    is_sign = token.kind == "operator" and token.text in "+-"
    if token.kind in {"operator", "close", "comma"} and not complete and not is_sign:
        before = "at the start" if previous is None else f"after {previous.text!r}"
        raise ExpressionError(
            f"an operand is expected {before}, but {token.text!r} was found",
            token.position,
        )


def _check_parentheses(tokens: Sequence[Token], depth: int) -> None:
    opened: list[tuple[Token, bool]] = []
    previous: Token | None = None
    for token in tokens:
        if token.kind == "open":
            is_call = previous is not None and previous.kind == "name"
            opened.append((token, is_call))
            if len(opened) > depth:
                raise ExpressionError(
                    f"parentheses are nested deeper than {depth}", token.position
                )
        elif token.kind == "close":
            if not opened:
                raise ExpressionError("')' closes nothing", token.position)
            opened.pop()
        elif token.kind == "comma" and not (opened and opened[-1][1]):
            raise ExpressionError(
                "a comma stands only between the arguments of a function",
                token.position,
            )
        previous = token
    if opened:
        raise ExpressionError("'(' is never closed", opened[-1][0].position)


def _check_signs(tokens: Sequence[Token], depth: int) -> None:
    run = 0
    for token in tokens:
        run = run + 1 if token.kind == "operator" else 0
        if run > depth:
            raise ExpressionError(f"more than {depth} signs in a row", token.position)
