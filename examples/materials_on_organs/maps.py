#!/usr/bin/python3
"""Draws the pictures of leaf.toml's materials over (U,V), U along the leaf with the columns, V across it with the rows.

variegation.pgm  which material is where: 0 green, 1 pale, 2 white
veins.pgm        which material is where: 0 lamina, 1 vein
relief.csv       height of the veins, 0 to 1: a vein is a ridge exp(-(d / w)^2), d from its middle
"""
import math
import random

COLUMNS, ROWS = 480, 240
LENGTH, WIDTH = 20.0, 11.0  # of the leaf in leaf.bpms, cm
PAIRS = 9  # of side veins


def centres():
    """(u, v) of every pixel, the first row at the top, where V is largest."""
    return [[((x + 0.5) / COLUMNS, 1 - (y + 0.5) / ROWS) for x in range(COLUMNS)] for y in range(ROWS)]


def waves(seed):
    """A smooth function of (u, v) between -1 and 1 or so: a sum of twelve waves."""
    draw = random.Random(seed)
    terms = [(draw.uniform(-14, 14), draw.uniform(-7, 7), draw.uniform(0, 2 * math.pi)) for _ in range(12)]
    return lambda u, v: sum(math.sin(a * u + b * v + c) for a, b, c in terms) / math.sqrt(12)


def variegation():
    """White towards the edge, green about the midrib, pale between them, with uneven borders."""
    outer, inner = waves(1), waves(2)

    def at(u, v):
        across = abs(2 * v - 1)
        # Fingers that follow the side veins.
        fingers = 0.05 * math.sin(2 * math.pi * PAIRS * (u - 0.2 * across))
        if across + 0.12 * outer(u, v) + fingers > 0.80:
            return 2
        return 1 if across + 0.16 * inner(u, v) + fingers > 0.52 else 0

    return [[at(u, v) for u, v in row] for row in centres()]


def relief():
    """The midrib, thick at the base, and side veins that leave it and bend forward; widths in cm."""

    def ridge(distance, width):
        return math.exp(-((distance / width) ** 2))

    def at(u, v):
        across = abs(v - 0.5) * WIDTH
        height = ridge(across, 0.28 * (1 - 0.7 * u))
        for k in range(PAIRS):
            # Where this vein is at this distance from the midrib: half as far forward, and bending.
            start = LENGTH * (0.03 + 0.78 * k / PAIRS)
            along = start + 0.45 * across + 0.05 * across**2
            slant = math.hypot(1.0, 0.45 + 0.1 * across)
            fade = max(0.0, 1 - across / (0.5 * WIDTH))
            height = max(height, 0.75 * fade**0.5 * ridge((u * LENGTH - along) / slant, 0.13))
        return height

    return [[at(u, v) for u, v in row] for row in centres()]


def write_pgm(path, rows, most):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"P2\n{COLUMNS} {ROWS}\n{most}\n" + "\n".join(" ".join(map(str, row)) for row in rows) + "\n")


if __name__ == "__main__":
    write_pgm("variegation.pgm", variegation(), 2)
    heights = relief()
    write_pgm("veins.pgm", [[1 if h > 0.55 else 0 for h in row] for row in heights], 1)
    with open("relief.csv", "w", encoding="ascii") as out:
        out.writelines(",".join(f"{h:.5f}" for h in row) + "\n" for row in heights)
