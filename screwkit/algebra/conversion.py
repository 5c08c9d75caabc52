"""Polynomials carried from one exact ring to another that knows the same symbols.

Each limb has a ring of its own, with the basis angles that suit it; what is found there
is spoken of in the ring of all limbs.
"""

from __future__ import annotations

from fractions import Fraction

from screwkit.algebra.evaluation import add_angles, multiply_angle
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


class Conversion:
    """The map from one ring to another, by the images of its generators.

    Raises:
        KeyError: If the target does not know a symbol, angle or root of the source.
    """

    def __init__(self, source: TrigonometricRing, target: TrigonometricRing) -> None:
        self._target = target
        images: dict[str, Polynomial] = {}
        for i, form in enumerate(source.basis):
            if form[0][0] in source.constant_angles:
                # A measure of the source need not be one of the target.
                made_of = source.measures.made_of[Fraction(form[0][0])]
                angles = [(target.radians(value), count) for value, count in made_of]
            else:
                angles = [(target.cosine_sine(name), count) for name, count in form]
            pair = (target.one, target.zero)
            for angle, count in angles:
                pair = add_angles(pair, multiply_angle(count, angle, target), target)
            images[f"c{i}"], images[f"s{i}"] = pair
        for i, name in enumerate(source.symbols):
            images[f"x{i}"] = target.symbol(name)
        roots = {e.of: e.name for e in target.extensions if e.kind == "root"}
        inverses = {e.of: e.name for e in target.extensions if e.kind == "inverse"}
        for extension in source.extensions:
            known = roots if extension.kind == "root" else inverses
            images[extension.name] = target.generator(known[extension.of])
        texts = {text: name for name, text in target.constant_generators.items()}
        for name, text in source.constant_generators.items():
            images[name] = target.generator(texts[text])
        self._images = [images[name] for name in source.names if name in images]

    def __call__(self, polynomial: Polynomial) -> Polynomial:
        """The same function of the symbols in the target ring, in normal form."""
        target = self._target
        if polynomial.is_constant():
            constant = target.context.constant(0)
            return constant if polynomial == 0 else constant + polynomial.coeffs()[0]
        image = polynomial.compose(*self._images, ctx=target.context)
        return target.normal(image)
