#!/usr/bin/python3
"""The maps of these examples: variegation.pgm (numbers of materials) and veins.pgm (heights). Columns run along the leaf
(U, from its base), rows across it (V, from the bottom row up)."""
import math

WIDTH, HEIGHT = 400, 160


def write(path, most, value):
    rows = [" ".join(str(value((x + 0.5) / WIDTH, (y + 0.5) / HEIGHT)) for x in range(WIDTH)) for y in range(HEIGHT)]
    with open(path, "w") as out:
        out.write(f"P2\n{WIDTH} {HEIGHT}\n{most}\n" + "\n".join(rows) + "\n")


def variegation(u, v):
    """0 green, 1 pale: margins that wander, with tongues towards the midrib; 2 the midrib."""
    across = abs(2 * v - 1)
    if across < 0.05 * (1 - 0.6 * u):
        return 2
    side = 1 if v > 0.5 else -1
    margin = 0.66 + 0.10 * math.sin(23 * u + side) + 0.07 * math.sin(61 * u + 2 * side) + 0.05 * math.sin(131 * u)
    return 1 if across > margin else 0


def vein(u, v):
    """The midrib as a ridge, and side veins that leave it forward; 0 to 255 of the height."""
    across = abs(2 * v - 1)
    midrib = math.exp(-((across / (0.10 * (1.1 - u))) ** 2))
    phase = (14 * (u - 0.22 * across)) % 1.0
    side = 0.35 * math.exp(-(((phase - 0.5) / 0.10) ** 2)) * (1 - across)
    return round(255 * min(1, midrib + side * (1 - midrib)))


write("variegation.pgm", 255, variegation)
write("veins.pgm", 255, vein)
