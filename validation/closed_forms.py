"""Planes, mirrors and booms, whose radiance is known exactly, and published values of BRDF models."""
import math

import pandas

import settings
from scenes import domain, lambertian, light, principal, simulate, soil

rounding = 1e-6  # of 32-bit weights


def lambertian_plane(section):
    angles = (-60, 0, 60)
    run = simulate(domain(2) + soil(lambertian(0.3)) + light(40) + principal(angles) + "[sampling]\nsamples = 64\n")
    section.equal_by("Lambertian plane 0.3, BRF at -60, 0, 60 degrees", float(abs(run.brf / 0.3 - 1).max()), rounding)


def tilted_plane(section):
    t = math.tan(math.radians(30))
    obj = f"v -5 -5 {5 * t}\nv 5 -5 {-5 * t}\nv 5 5 {-5 * t}\nv -5 5 {5 * t}\nf 1 2 3\nf 1 3 4\n"
    run = simulate('[domain]\nboundary = "open"\n[materials.leaf]\n' + lambertian(0.5) + '\n[prototypes.p]\nmesh = "p.obj"\nup = "z"\n'
                   'material = "leaf"\n[[instances]]\nprototype = "p"\npositions = [[0, 0, 0]]\n' + light(50, 90, 100.0)
                   + '[[sensors]]\nname = "camera"\ntype = "perspective"\nlocation = [0, 0, 10]\ndirection = [0, 0, -1]\nfov_deg = 20\n'
                   "width_px = 8\nheight_px = 8\n[sampling]\nsamples = 32\n", {"p.obj": obj})  # fmt: skip
    expected = 0.5 / math.pi * 100 * math.cos(math.radians(20))
    section.equal_by("plane tilted by 30 degrees under a sun at 50: radiance of 64 pixels", float(abs(run.radiance.astype(float) / expected - 1).max()), rounding)


def sun_disc(section):
    """A mirror shows the sun's disc: E / (pi sin^2 radius) within it, nothing beside it."""
    run = simulate(domain(2) + soil('type = "srm"\nspecular_reflectance = 0.6')
                   + "[illumination]\nsun = { zenith_deg = 40, azimuth_deg = 120, irradiance = 3.0, radius_deg = 2.0 }\n"
                   '[[sensors]]\nname = "v"\ntype = "brf"\nviews = [[40, 300], [41.5, 300], [43, 300]]\n'
                   "[sampling]\nsamples = 1024\nroulette = false\n")  # fmt: skip
    disc = 0.6 * 3 / (math.pi * math.sin(math.radians(2)) ** 2)
    off = max(abs(float(run.radiance[view, 0]) / disc - seen) for view, seen in enumerate((1, 1, 0)))
    section.equal_by("sun of radius 2 degrees in a mirror: 0 and 1.5 degrees off its centre, and 3", off, 1e-4)


def sun_disc_irradiance(section):
    """A cone of radiance L that is wholly above the horizon gives L pi sin^2(radius) cos(zenith) to the horizontal, and without
    the cosine to the plane normal to it: E cos(zenith) whatever the radius."""
    run = simulate(domain(2) + soil(lambertian(0.3))
                   + "[illumination]\nsun = { zenith_deg = 50, azimuth_deg = 0, irradiance = 3.0, radius_deg = 5.0 }\n"
                   + principal([0, 30]) + "[sampling]\nsamples = 262144\n")  # fmt: skip
    for view, vza in enumerate((0, 30)):
        section.compare(f"Lambertian plane 0.3 under a sun of radius 5 degrees, radiance at {vza} degrees", float(run.radiance[view, 0]),
                        float(run.radiance_se[view, 0]), 0.3 / math.pi * 3 * math.cos(math.radians(50)))  # fmt: skip


def boom(section):
    """A chessboard that fills the boom's rectangle is the same picture in each of five orthographic views, if each sees the same
    corners."""
    side = 1.0
    obj = (f"v {-side} {-side} 0.1\nv {side} {-side} 0.1\nv {side} {side} 0.1\nv {-side} {side} 0.1\n"
           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n")  # fmt: skip
    board = "P2\n2 2\n1\n1 0\n0 1\n"
    run = simulate('[domain]\nboundary = "open"\n[materials.dark]\n' + lambertian(0.2) + "\n[materials.bright]\n" + lambertian(0.6)
                   + '\n[materials.board]\ntype = "map"\nfile = "board.pgm"\nmaterials = ["dark", "bright"]\n'
                   '[prototypes.p]\nmesh = "p.obj"\nup = "z"\nmaterial = "board"\n[[instances]]\nprototype = "p"\npositions = [[0, 0, 0]]\n'
                   + light(30, 180) + f'[[sensors]]\nname = "b"\ntype = "boom"\nabout = [0, 0, 0.1]\nplane = "principal"\nvza_deg = [-60, -30, 0, 30, 60]\n'
                   f"distance_m = 10\narea_m = [{2 * side}, {2 * side}]\nwidth_px = 16\nheight_px = 16\n[sampling]\nsamples = 32\n",
                   {"p.obj": obj, "board.pgm": board})  # fmt: skip
    images = [run[f"b_{name}_radiance"][:, :, 0].values for name in ("m60", "m30", "0", "30", "60")]
    first = images[2][0, 0] > 0.4  # the board looks alike from both sides: turned by 180 degrees
    off = 0.0
    for image in images:
        rows, columns = image.shape
        assert rows % 2 == 0, f"{rows} rows cannot show two squares"
        for y in range(rows):
            for x in range(columns):
                expected = 0.6 if ((y < rows / 2) == (x < columns / 2)) == first else 0.2
                off = max(off, abs(float(image[y, x]) / expected - 1))
    section.equal_by("boom, five orthographic views of a chessboard that fills its rectangle: every pixel", off, rounding)


def perspective_boom(section):
    """The ends of the rectangle's centre line lie on the image's edges: tan a = (h/2) cos / (R -+ (h/2) sin) from the line to the point.
    A bright sheet as wide, but 0.87 times as long as the rectangle, fills a known part of the middle column."""
    half, shorter, distance = 1.0, 0.87, 6.0
    obj = "".join(f"v {x} {y} 0\n" for x, y in ((-half, -shorter), (half, -shorter), (half, shorter), (-half, shorter))) + "f 1 2 3\nf 1 3 4\n"
    angles = (-60, -30, 0, 30, 60)
    run = simulate('[domain]\nboundary = "open"\n[materials.leaf]\n' + lambertian(0.5)
                   + '\n[prototypes.p]\nmesh = "p.obj"\nup = "z"\nmaterial = "leaf"\n[[instances]]\nprototype = "p"\npositions = [[0, 0, 0]]\n'
                   + light(30, 180) + f'[[sensors]]\nname = "b"\ntype = "boom"\nprojection = "perspective"\nabout = [0, 0, 0]\nplane = "principal"\n'
                   f"vza_deg = {list(angles)}\ndistance_m = {distance}\narea_m = [{2 * half}, {2 * half}]\nwidth_px = 41\nheight_px = 40\n"
                   "[sampling]\nsamples = 1024\n", {"p.obj": obj})  # fmt: skip
    for name, zenith in zip(("m60", "m30", "0", "30", "60"), angles):
        z = math.radians(abs(zenith))

        def ends(h):
            return [math.atan(h * math.cos(z) / (distance + sign * h * math.sin(z))) for sign in (-1, 1)]

        near, far = ends(half)
        field, off = (near + far) / 2, (near - far) / 2
        a, b = ends(shorter)
        expected = (math.tan(a - off) + math.tan(b + off)) / (2 * math.tan(field))
        column = run[f"b_{name}_radiance"][:, 20, 0].values.astype(float) / 0.5
        error = run[f"b_{name}_radiance_se"][:, 20, 0].values.astype(float) / 0.5
        section.compare(f"boom, perspective, vza {zenith}: part of the middle column that a sheet of 0.87 of the length fills", float(column.mean()),
                        math.sqrt(float((error**2).sum())) / len(column), expected)  # fmt: skip


def published_brdfs(section):
    table = pandas.read_csv(settings.data / "analytic/brdf_reference_values.csv", comment="#", nrows=210)
    table = table[table.model.str.startswith(("RPV", "VPD"))]
    worst = {}
    table["model"] = table.model.str.extract(r"^(\w+)", expand=False)
    for (model, params, sza), part in table.groupby(["model", "params", "sza"]):
        p = dict(word.split("=") for word in params.split() if "=" in word)
        if model == "RPV":
            body = f'type = "rpv"\nrho0 = {p["rho0"]}\nk = {p["k"]}\ntheta = {p["Theta"]}\nrhoc = {p["rhoc"]}'
        else:
            phase = {"0": '"isotropic"', "1": f'"henyey_greenstein"\nasymmetry = {p["a1"]}', "2": f'"legendre"\na1 = {p["a1"]}\na2 = {p["a2"]}'}
            body = (f'type = "verstraete_pinty_dickinson"\nw = {p["w"]}\nsunfleck_radius_m = {p["r"]}\narea_density_m2_m3 = {p["Lambda"]}\n'
                    f'chi = {p["chil"]}\nmultiple_scattering = {"true" if p["ms"] != "0" else "false"}\nphase = {phase[p["phase"]]}')  # fmt: skip
        views = ", ".join(f"[{v}, {f}]" for v, f in zip(part.vza, part.phi))
        run = simulate(domain(2) + soil(body) + light(sza) + f'[[sensors]]\nname = "pp"\ntype = "brf"\nviews = [{views}]\n'
                       "[sampling]\nsamples = 32\n")  # fmt: skip
        off = abs(run.brf.values[:, 0] - part.BRF.values) / part.BRF.values
        count, most = worst.get(model, (0, 0))
        worst[model] = (count + len(off), max(most, float(off.max())))
    for model, (count, most) in worst.items():
        section.equal_by(f"{model} plane, {count} BRFs of `brdf_reference_values.csv`", most, 2e-6)  # half of the file's last digit


def validate(page):
    section = page.section("Closed forms", "But for the sun's disc and pixels at edges nothing is averaged: results are exact to the rounding of 32-bit weights, "
                           "published values to the digits of their file.")  # fmt: skip
    lambertian_plane(section)
    tilted_plane(section)
    sun_disc(section)
    boom(section)
    published_brdfs(section)
    sun_disc_irradiance(section)
    perspective_boom(section)
