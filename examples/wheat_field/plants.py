#!/usr/bin/env python3
"""Measured wheat as plant files.

    plants.py midribs DATA DATE OUT.csv             the clicked midribs as a table for `bpms fit`
    plants.py plants DATA DATE FIT.json FOLDER      the plants and four canopies of them
"""
import json
import os
import random
import sys

import measurements as m

AXIS_SPREAD_DEG = {True: 30.0, False: 5.0}  # half the range of a blade's turn beyond 180 degrees: upper four, lower ones
TILLER_LEAN_DEG = 5.0
SEEDS = (1, 2, 3, 4)
SIDE_M = 1.43  # of the square that repeats: ten rows


def write_midribs(data, date, path):
    plants, _ = m.read_plants(data, date)
    with open(path, "w") as out:
        out.write("plant,rank,point,x_cm,z_cm\n")
        for plant in plants:
            for rank, points in sorted(plant.midribs.items()):
                for k, (x, z) in enumerate(points):
                    out.write(f"{plant.name},{rank},{k},{x},{z}\n")


class Shapes:
    """Fitted inclinations by rank; a blade without its own takes one of its rank (or the nearest) on another plant."""

    def __init__(self, fit_path, plants):
        with open(fit_path) as report:
            organs = json.load(report)["organs"]
        heights = {p.name: p.heights for p in plants}
        self.own, self.by_rank = {}, {}
        for organ in organs:
            function = organ["functions"].get("inclination")
            if function is None:
                continue
            name, rank = organ["plant"], int(organ["rank"])
            text = f"{function['kind']} " + " ".join(f"{c:.6g}" for c in function["coefficients"])
            shape = (text, heights[name][rank])
            self.own[name, rank] = shape
            self.by_rank.setdefault(rank, []).append(shape)

    def of(self, name, rank, draw):
        if (name, rank) in self.own:
            return self.own[name, rank]
        nearest = min(self.by_rank, key=lambda r: (abs(r - rank), r))
        return draw.choice(self.by_rank[nearest])


def leaf(number, blade, inclination):
    """The block of a blade. Wheat senesces from the tip."""
    width = max(blade.widths)
    lines = [f"a_length {blade.length:.4f}  a_width {width:.4f}", f"f_inclination {inclination}",
             "f_width n " + " ".join(f"{k / (m.STATIONS - 1):.2f} {w / width:.4f}" for k, w in enumerate(blade.widths))]
    dead = dead_length(blade)
    if dead > 0:
        lines.append(f"a_senescent {dead:.4f}  senescent_material dead_leaf")
    return f"l({number})", f"l {number} {{ material leaf  " + "\n      ".join(lines) + " }\n"


def dead_length(blade):
    """Part of the length, from the tip, that holds the senescent part of the area."""
    wanted, sum_, step = blade.senescent * blade.area, 0.0, blade.length / (m.STATIONS - 1)
    for k in reversed(range(m.STATIONS - 1)):
        piece = (blade.widths[k] + blade.widths[k + 1]) / 2 * step
        if sum_ + piece >= wanted:
            return (m.STATIONS - 1 - k - 1 + (wanted - sum_) / piece) / (m.STATIONS - 1) if piece > 0 else 0.0
        sum_ += piece
    return 1.0


class PlantText:
    def __init__(self, radius, draw):
        self.word, self.blocks, self.radius, self.draw = "", "", radius, draw
        self.leaves = self.stems = self.turns = 0

    def axis(self, blades, lean, turn):
        """blades: (height, Blade, inclination) from the lowest up."""
        self.turns += 1
        self.word += f"[+({self.turns})"
        self.blocks += f"+ {self.turns} {{ a_twist {turn:.1f} }}\n"
        below, azimuth, first = 0.0, 0.0, True
        for k, (height, blade, inclination) in enumerate(blades):
            if height > below + 0.01:
                self.stems += 1
                tilt = f"  a_inclination {lean}" if first and lean else ""
                self.word += f"s({self.stems})"
                self.blocks += f"s {self.stems} {{ material stem  a_length {height - below:.3f}  a_radius {self.radius:.4f}{tilt} }}\n"
                below, first = height, False
            upper = len(blades) - k <= 4
            azimuth += 180 + self.draw.uniform(-1, 1) * AXIS_SPREAD_DEG[upper]
            self.leaves += 1
            self.turns += 1
            letter, block = leaf(self.leaves, blade, inclination)
            self.word += f"[+({self.turns}){letter}]"
            self.blocks += f"+ {self.turns} {{ a_twist {azimuth % 360:.1f} }}\n" + block
        self.word += "]"

    def text(self):
        return f"units cm\n{self.word}\n{self.blocks}"


def tillers(plant, shapes, ratio, draw):
    """The scanned blades of all tillers, dealt out to axes of as many blades as the main stem has. A tiller's blade has the height
    of the main stem's blade that is as far from the top, times the ratio of the collars, and its inclination."""
    ranks = sorted(plant.blades)
    blades = plant.tiller_blades[:]
    draw.shuffle(blades)
    count = max(1, round(len(blades) / len(ranks))) if blades else 0
    for t in range(count):
        mine = sorted(blades[t::count], key=lambda b: b.length)
        chosen = ranks[-len(mine):] if len(mine) <= len(ranks) else [ranks[0]] * (len(mine) - len(ranks)) + ranks
        axis = []
        for rank, blade in zip(chosen, mine):
            inclination, height = shapes.of(plant.name, rank, draw)
            axis.append((ratio * height, blade, inclination))
        yield sorted(axis, key=lambda a: a[0])


def canopy(date, seed, count, density, spacing):
    return f"""# {m.DATES[date]}: {count} measured plants, {density:.0f} a square metre in rows {spacing} m apart
[domain]
size_m = [{SIDE_M}, {SIDE_M}]
seed = {seed}

[[plants]]
folder = "plants_{date}"
rotation = {{ type = "uniform" }}

[planting]
pattern = "rows"
row_spacing_m = {spacing}
density_per_m2 = {density:.0f}
in_row = "random"
"""


def write_plants(data, date, fit_path, folder):
    plants, notes = m.read_plants(data, date)
    shapes = Shapes(fit_path, plants)
    radius, ratio = m.stem_diameter(data) / 2, m.collar_ratio(data)
    densities, spacing = m.plot(data)
    os.makedirs(f"{folder}/plants_{date}", exist_ok=True)
    for plant in plants:
        draw = random.Random(f"{date} {plant.name}")
        text = PlantText(radius, draw)
        main = [(shapes.of(plant.name, rank, draw)[::-1], blade) for rank, blade in sorted(plant.blades.items())]
        text.axis(sorted(((height, blade, shape) for (height, shape), blade in main), key=lambda a: a[0]), 0, draw.uniform(0, 360))
        for axis in tillers(plant, shapes, ratio, draw):
            text.axis(axis, TILLER_LEAN_DEG, draw.uniform(0, 360))
        with open(f"{folder}/plants_{date}/plant{plant.name}.bpms", "w") as out:
            out.write(text.text())
    for seed in SEEDS:
        with open(f"{folder}/canopy_{date}_{seed}.toml", "w") as out:
            out.write(canopy(date, seed, len(plants), densities[date], spacing))
    area = sum(b.area for p in plants for b in [*p.blades.values(), *p.tiller_blades]) / len(plants)
    dead = sum(b.area * b.senescent for p in plants for b in [*p.blades.values(), *p.tiller_blades]) / len(plants)
    print(f"{m.DATES[date]}: {len(plants)} plants, {area:.1f} cm2 of blades a plant ({dead:.1f} dead), LAI {area * densities[date] / 1e4:.2f}"
          + "".join(f"; left out: {n}" for n in notes))


if __name__ == "__main__":
    if len(sys.argv) == 5 and sys.argv[1] == "midribs":
        write_midribs(*sys.argv[2:])
    elif len(sys.argv) == 6 and sys.argv[1] == "plants":
        write_plants(*sys.argv[2:])
    else:
        sys.exit(__doc__)
