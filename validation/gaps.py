"""Gap fraction, bidirectional gap and direct transmittance of random discs: 1 - G a / (A mu) for each of N discs."""
import math

import scenes
from chart import Chart
from page import mean_of
from scenes import domain, flux, lambertian, leaf, light, prototype, sampling, simulate, soil, views
from settings import figures

lai, radius_m, size_m, sza, drawings = 1.5, 0.02, 2, 30, 16


def through(zenith_deg):
    """Of N discs with spherical normals (G = 0.5), each met or not by itself; exp(-G LAI / mu) to within 1e-4 here."""
    n = scenes.disc_count(lai, radius_m, size_m)
    return (1 - 0.5 * math.pi * radius_m**2 / (size_m**2 * math.cos(math.radians(zenith_deg)))) ** n


def validate(page):
    section = page.section("Gaps", f"{drawings} drawings of random discs (LAI {lai}, radius {1000 * radius_m:.0f} mm, spherical normals): one drawing has gaps of "
                           "its own, so that the error is that between drawings. Expected: (1 - G a / (A mu))^N, which tends to exp(-G LAI / mu), and for the "
                           "sunlit ground seen far from the hot spot the product of both.")  # fmt: skip
    angles = list(range(0, 81, 10))
    gap, lit, direct = {a: [] for a in angles}, {a: [] for a in angles}, []
    for draw in range(1, drawings + 1):
        run = simulate(domain(size_m) + leaf(0.45, 0.35) + prototype("discs", "discs.def") + soil(lambertian(0.2)) + light(sza, 0)
                       + views([[a, 180] for a in angles]) + flux + sampling(8192, "max_order = 1"),
                       {"discs.def": scenes.discs(lai, radius_m, size_m, 0.05, 2, draw)}, seed=draw)  # fmt: skip
        for i, angle in enumerate(angles):
            gap[angle].append(float(run.gap[i]))
            lit[angle].append(float(run.bidirectional_gap[i]))
        direct.append(float(run.flux_transmitted_direct[0]))
    means = {a: mean_of(gap[a]) for a in angles}
    for angle in (0, 30, 60):
        section.compare(f"gap fraction at {angle} degrees", *means[angle], through(angle))
    section.compare(f"direct transmittance (`flux`), sun at {sza}", *mean_of(direct), through(sza))
    for angle in (20, 40, 60):
        section.compare(f"bidirectional gap, sun at {sza}, view at {angle} on the far side", *mean_of(lit[angle]), through(sza) * through(angle))
    chart = Chart("Gap fraction of random discs, LAI 1.5", "view zenith / degrees", "gap fraction")
    chart.line("exp(-G LAI / mu)", range(0, 86), [math.exp(-0.5 * lai / math.cos(math.radians(a))) for a in range(0, 86)])
    chart.points(f"bpms, {drawings} drawings", angles, [means[a][0] for a in angles], [means[a][1] for a in angles])
    joint = [mean_of(lit[a]) for a in angles]
    chart.line(f"the same times that of the sun at {sza}", range(0, 86),
               [math.exp(-0.5 * lai * (1 / math.cos(math.radians(a)) + 1 / math.cos(math.radians(sza)))) for a in range(0, 86)], dashed=True)  # fmt: skip
    chart.points("bpms, bidirectional gap", angles, [m[0] for m in joint], [m[1] for m in joint])
    chart.write(figures / "gap.svg")
    section.figure("gap.svg", "Gap fraction and bidirectional gap over the view zenith")
