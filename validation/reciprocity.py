"""Light takes every way in both directions, and light adds up."""
import math

import scenes
from scenes import domain, lambertian, leaf, light, prototype, sampling, simulate, soil, views, white_sky


def scene():
    two_faces = leaf(0.6, 0.2) + "reflectance_back = 0.2\n"
    return domain(2) + two_faces + prototype("discs", "discs.def") + soil(lambertian(0.4)), {"discs.def": scenes.discs(2, 0.1, 2, 0.1, 0.8, 1)}


def both(run, name="hdrf", view=0):
    return float(run[name][view, 0]), float(run[name + "_se"][view, 0])


def validate(page):
    section = page.section("Reciprocity and superposition", "Random discs of two faces (0.6 and 0.2, transmittance 0.2) over soil 0.4, LAI 2, and the canopy of bench_hom.")
    text, files = scene()
    for zenith, azimuth in ((15, 40), (50, 75), (70, 250)):
        seen = simulate(text + white_sky + views([[zenith, azimuth]]) + sampling(131072), files)
        spread = simulate(text + light(zenith, azimuth) + scenes.albedo + sampling(131072), files, seed=12)
        section.compare(f"orthographic view at {zenith} under an isotropic sky, and DHR of the sun there", *both(seen), *both(spread, "dhr"))
    nir = scenes.bench_hom(leaf(0.4957, 0.4409), lambertian(0.159))
    seen = simulate(nir + white_sky + views([[20, 0]]) + sampling(65536))
    spread = simulate(nir + light(20) + scenes.albedo + sampling(65536), seed=12)
    section.compare("the same of bench_hom, near infrared, at 20", *both(seen), *both(spread, "dhr"))
    there = simulate(text + light(60, 130) + views([[15, 40]]) + sampling(262144), files)
    back = simulate(text + light(15, 40) + views([[60, 130]]) + sampling(262144), files, seed=12)
    section.compare("sun and view change places, 60/130 and 15/40: BRF", *both(there, "brf"), *both(back, "brf"))
    # A sky that is brighter on one side; (1 - f) BRF of the sun + f HDRF of the sky is the scene under both.
    rows = "".join(f"{z},{a},{1 + math.sin(math.radians(z)) * (0.8 * math.cos(math.radians(a - 100)) + 0.5)}\n" for z in range(0, 91, 5) for a in range(0, 360, 15))
    files = {**files, "sky.csv": "zenith_deg,azimuth_deg,radiance\n" + rows}
    looks = views([[0, 0], [40, 100], [60, 280]])

    def sky(irradiance):
        return f'sky = {{ type = "map", file = "sky.csv", irradiance = {irradiance} }}\n'

    of_sun = simulate(text + light(50, 100) + looks + sampling(65536), files)
    of_sky = simulate(text + "[illumination]\n" + sky('"brf"') + looks + sampling(65536), files, seed=12)
    for f in (0.15, 0.6):
        run = simulate(text + light(50, 100, (1 - f) * math.pi / math.cos(math.radians(50))) + sky(f * math.pi) + looks + sampling(65536), files, seed=13)
        for view, vza in enumerate((0, 40, 60)):
            (a, a_error), (b, b_error) = both(of_sun, "brf", view), both(of_sky, "hdrf", view)
            section.compare(f"HDRF at {vza} under sun and uneven sky, diffuse fraction {f}, and recombined", *both(run, "hdrf", view), (1 - f) * a + f * b,
                            math.hypot((1 - f) * a_error, f * b_error))  # fmt: skip
