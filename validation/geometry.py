"""One shape stated in two ways reflects the same: instances and one mesh, a cell and its tiling, patches and fine triangles."""
import math
import random

import numpy
import pandas

from scenes import discs, domain, lambertian, leaf, light, prototype, sampling, simulate, soil, views

looks = [[0, 0], [20, 30], [35, 100], [45, 200], [60, 330], [70, 280]]
leaf_text = leaf(0.5, 0.3) + "reflectance_back = 0.3\n"


def plane_of(section, what, one, other):
    section.plane(what, pandas.DataFrame({"value": one.brf[:, 0], "error": one.brf_se[:, 0], "reference": other.brf[:, 0], "reference_error": other.brf_se[:, 0]}))


def run(kind, file, files, seed, positions="[[0, 0, 0]]", size=2):
    up = 'up = "z"\n' if kind == "mesh" else ""
    return simulate(domain(size) + leaf_text + prototype(kind, file, positions).replace("material =", up + "material =") + soil(lambertian(0.3)) + light(35, 100)
                    + views(looks) + sampling(65536), files, seed)  # fmt: skip


def obj(corners):
    lines = [f"v {x:.9f} {y:.9f} {z:.9f}" for x, y, z in corners]
    lines += [f"f {i + 1} {i + 2} {i + 3}" for i in range(0, len(corners), 3)]
    return "\n".join(lines) + "\n"


def mesh_and_instances(section):
    numbers = random.Random(4)
    tuft = []
    for _ in range(60):
        at = [numbers.uniform(-0.4, 0.4), numbers.uniform(-0.4, 0.4), numbers.uniform(0.2, 0.7)]
        tuft += [[c + numbers.uniform(-0.15, 0.15) for c in at] for _ in range(3)]
    places, written = [], []
    for _ in range(6):
        x, y, turn = numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(0, 360)
        places.append([x, y, 0, turn])
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        written += [[1.2 * (c * p[0] - s * p[1]) + x, 1.2 * (s * p[0] + c * p[1]) + y, 1.2 * p[2]] for p in tuft]
    plane_of(section, "six instances (turned, scaled) - one mesh", run("mesh", "m.obj", {"m.obj": obj(tuft)}, 1, f"{places}\nscale = 1.2"),
             run("mesh", "m.obj", {"m.obj": obj(written)}, 2))  # fmt: skip


def cell_and_tiling(section):
    rows = discs(2, 0.1, 1.5, 0.1, 0.8, 3)
    tiles = [[x * 1.5, y * 1.5, 0] for x in (-1, 0, 1) for y in (-1, 0, 1)]
    plane_of(section, "periodic cell - nine of it in a larger cell", run("discs", "d.def", {"d.def": rows}, 1, size=1.5),
             run("discs", "d.def", {"d.def": rows}, 2, tiles, size=4.5))  # fmt: skip


def patches_and_triangles(section):
    points = []
    for i in range(4):
        for j in range(4):
            along, across = i / 3, j / 3 - 0.5
            turn, width = math.radians(60) * along, 0.12 * (1.2 - along)
            points.append([0.4 * along, across * width * math.cos(turn),
                           0.3 + 0.5 * along - 0.6 * along**2 + across * width * math.sin(turn) + 0.03 * abs(across)])  # fmt: skip
    net = numpy.array(points).reshape(4, 4, 3)

    def bernstein(t):
        return numpy.array([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3])

    steps = 32
    at = [[numpy.einsum("i,j,ijk->k", bernstein(i / steps), bernstein(j / steps), net) for j in range(steps + 1)] for i in range(steps + 1)]
    corners = []
    for i in range(steps):
        for j in range(steps):
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 0), (1, 1), (0, 1)):
                corners.append(at[i + a][j + b])
    numbers = random.Random(7)
    places = [[numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(0, 0.5), numbers.uniform(0, 360)] for _ in range(80)]
    patch = "".join(f"{x} {y} {z}\n" for x, y, z in points)
    plane_of(section, f"Bezier patches - {2 * steps * steps} triangles each", run("patches", "leaf.bpt", {"leaf.bpt": patch}, 1, places),
             run("mesh", "m.obj", {"m.obj": obj(corners)}, 2, places))  # fmt: skip


def validate(page):
    section = page.section("One shape, two statements", f"BRF of {len(looks)} views, each pair from paths of its own.")
    mesh_and_instances(section)
    cell_and_tiling(section)
    patches_and_triangles(section)
