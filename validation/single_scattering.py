"""Single scattering of random discs and its limit, the turbid medium (Ross 1981):
BRF1 = Gamma / (mu mu0) (1 - exp(-(K + k) LAI)) / (K + k). Discs of radius r have a hot spot whose size is O(r), so that the limit
is 2 BRF1(r/2) - BRF1(r); in the hot spot itself exp(-K z) takes the place of exp(-(K + k) z), whatever the radius."""
import math

import scenes
from chart import Chart
from page import mean_of
from scenes import domain, lambertian, leaf, light, prototype, sampling, simulate, soil, views
from settings import figures

rho, tau, lai, sza, size_m, drawings = 0.5, 0.3, 1.5, 30, 3, 24
angles = [-75, -60, -45, -38, -34, -30, -26, -22, -15, 0, 15, 30, 45, 60, 75]  # in the principal plane


def turbid(vza, hot=False):
    mu0, mu = math.cos(math.radians(sza)), math.cos(math.radians(vza))
    cosine = 1.0 if hot else mu0 * mu + math.sin(math.radians(sza)) * math.sin(math.radians(-vza))
    beta = math.pi - math.acos(min(1.0, cosine))
    gamma = (rho + tau) / (3 * math.pi) * (math.sin(beta) - beta * math.cos(beta)) + tau / 3 * math.cos(beta)
    extinction = 0.5 / mu0 if hot else 0.5 / mu0 + 0.5 / mu
    return gamma / (mu0 * mu) * (1 - math.exp(-extinction * lai)) / extinction


def canopies(radius_m):
    found = [[] for _ in angles]
    for draw in range(1, drawings + 1):
        run = simulate(domain(size_m) + leaf(rho, tau) + prototype("discs", "discs.def") + soil(lambertian(0)) + light(sza)
                       + views([[abs(a), 0 if a < 0 else 180] for a in angles]) + sampling(4096, "max_order = 1"),
                       {"discs.def": scenes.discs(lai, radius_m, size_m, 0.02, 2, draw)}, seed=draw)  # fmt: skip
        for i in range(len(angles)):
            found[i].append(float(run.brf_by_component.sel(component="co_sgl")[i, 0]))
    return [mean_of(values) for values in found]


def validate(page):
    section = page.section("Single scattering and the turbid medium", f"`co_sgl` of {drawings} disc canopies each of two radii (LAI {lai}, spherical normals, rho {rho}, "
                           f"tau {tau}, sun at {sza}), extrapolated to no radius, against the closed form; and the hot spot, which no radius changes.")  # fmt: skip
    wide, narrow = canopies(0.02), canopies(0.01)
    limit = [(2 * n[0] - w[0], math.hypot(2 * n[1], w[1])) for w, n in zip(wide, narrow)]
    for angle in (-75, 0, 15, 30, 60):
        section.compare(f"turbid limit of `co_sgl`, vza {angle}", *limit[angles.index(angle)], turbid(angle))
    for radius, found in ((20, wide), (10, narrow)):
        section.compare(f"hot spot of discs of {radius} mm, vza {-sza}", *found[angles.index(-sza)], turbid(-sza, hot=True))
    chart = Chart("Single scattering of discs, LAI 1.5, sun at 30 degrees", "view zenith / degrees, negative on the sun's side", "BRF of order 1")
    chart.line("turbid medium, closed form", range(-75, 76), [turbid(a) for a in range(-75, 76)])
    chart.points("discs of 20 mm", angles, [m[0] for m in wide], [m[1] for m in wide])
    chart.points("discs of 10 mm", angles, [m[0] for m in narrow], [m[1] for m in narrow])
    chart.line("hot spot, closed form (at -30 degrees)", [-33, -27], [turbid(-sza, hot=True)] * 2, dashed=True)
    chart.write(figures / "single_scattering.svg")
    section.figure("single_scattering.svg", "Single scattering of discs of two radii and of the turbid medium in the principal plane")
