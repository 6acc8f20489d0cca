"""Fluxes of disc canopies extrapolated to the radius 0, against an independent tracer of turbid media. Discs differ from a turbid
medium by their hot spot, so canopies of three radii are taken to 0 by the parabola through them."""
import math

import pandas

import scenes
import settings
from chart import Chart
from page import mean_of
from scenes import domain, flux, lambertian, leaf, light, prototype, sampling, simulate, soil

radii = (0.04, 0.02, 0.01)
weights = {0.04: 1 / 3, 0.02: -2, 0.01: 8 / 3}  # the parabola through three radii, at 0
drawings = 16
named = {"reflected": "albedo", "absorbed_canopy": "fabs_leaf", "transmitted": "ftran", "transmitted_direct": "ftran_dir"}


def extrapolated(of):
    """By flux: the means of each radius, and the limit."""
    means = {key: {} for key in named}
    for radius in radii:
        draws = {key: [] for key in named}
        for draw in range(1, drawings + 1):
            run = simulate(domain(2) + leaf(of.rho, of.tau) + prototype("discs", "discs.def") + soil(lambertian(of.soil)) + light(of.sza) + flux
                           + sampling(65536), {"discs.def": scenes.discs(of.LAI, radius, 2, 0.04, 2, draw)}, seed=draw)  # fmt: skip
            for key in named:
                draws[key].append(float(run[key][0]))
        for key in named:
            means[key][radius] = mean_of(draws[key])
    limits = {key: (sum(weights[r] * m[r][0] for r in radii), math.sqrt(sum((weights[r] * m[r][1]) ** 2 for r in radii))) for key, m in means.items()}
    return means, limits


def validate(page):
    section = page.section("Discs and the turbid medium", f"Fluxes (`flux` sensor) of {drawings} canopies each of discs of 4, 2 and 1 cm, extrapolated to the radius 0 by a "
                           "parabola, against `turbid_1d_mc_fluxes.csv`; the direct transmittance against exp(-G LAI / mu). The error is that between "
                           "canopies, carried through.")  # fmt: skip
    table = pandas.read_csv(settings.data / "analytic/turbid_1d_mc_fluxes.csv", comment="#").set_index("case")
    for case in ("MYNENI88B", "HOM03_TUR_UNI_NIR_20", "HOM03_TUR_UNI_RED_20"):
        of = table.loc[case]
        means, limits = extrapolated(of)
        for key, column in named.items():
            if key == "transmitted_direct":
                reference, its_error = math.exp(-0.5 * of.LAI / math.cos(math.radians(of.sza))), 0
            else:
                reference, its_error = of[column], of[column + "_se"]
            section.compare(f"{case}: {key.replace('_', ' ')}", *limits[key], reference, its_error)
        if case == "MYNENI88B":
            chart = Chart("Albedo of disc canopies and its limit, Myneni 1988 (LAI 4)", "disc radius / m", "albedo")
            albedo = means["reflected"]
            chart.points(f"disc canopies, {drawings} each", albedo, [m[0] for m in albedo.values()], [m[1] for m in albedo.values()])
            chart.points("extrapolated", [0], [limits["reflected"][0]], [limits["reflected"][1]])
            chart.points("turbid medium, independent tracer", [0.0005], [of.albedo], [of.albedo_se])
            chart.write(settings.figures / "turbid.svg")
    section.figure("turbid.svg", "Albedo of disc canopies of three radii, extrapolated to the turbid medium")
