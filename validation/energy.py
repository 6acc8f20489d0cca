"""Nothing is made and nothing lost: white furnaces, the purist canopy, and fluxes that add up in every kind of scene."""

import scenes
from page import mean_of
from scenes import domain, flux, lambertian, leaf, light, prototype, sampling, simulate, soil, views, white_sky
import prospect


def discs(leaf_text, soil_text):
    return domain(2) + leaf_text + prototype("discs", "discs.def") + soil(soil_text), {"discs.def": scenes.discs(2, 0.1, 2, 0.1, 0.8, 1)}


def furnaces(section):
    looks = [[0, 0], [45, 30], [75, 200]]
    text, files = discs(leaf(0.7, 0.3), lambertian(1))
    run = simulate(text + white_sky + views(looks) + sampling(2048, "roulette = false"), files)
    section.equal_by("white furnace (leaf 0.7 + 0.3, ground 1, sky of radiance 1, no roulette), three views: every path",
                     max(float(abs(run.hdrf - 1).max()), float(run.hdrf_se.max())), 1e-6)  # fmt: skip
    two = leaf("[[600, 0.35], [700, 0.6]]", "[[600, 0.65], [700, 0.4]]")
    run = simulate(discs(two, lambertian(1))[0] + white_sky + views(looks) + "[bands]\nwavelengths_nm = [600, 700]\n"
                   + sampling(65536, "roulette = false"), files)  # fmt: skip
    for band, name in enumerate(("0.35 + 0.65", "0.6 + 0.4")):
        section.compare(f"white furnace, two bands carried together, leaf {name}, nadir", float(run.hdrf[0, band]), float(run.hdrf_se[0, band]), 1)
    even = "zenith_deg,azimuth_deg,radiance\n" + "".join(f"{z},{a},1\n" for z in range(0, 91, 10) for a in range(0, 360, 30))
    run = simulate(text + '[illumination]\nsky = { type = "map", file = "even.csv" }\n' + views(looks) + sampling(65536, "roulette = false"),
                   {**files, "even.csv": even})  # fmt: skip
    for view, (zenith, _) in enumerate(looks):
        section.compare(f"white furnace under a sampled sky map of radiance 1, view at {zenith}", float(run.hdrf[view, 0]), float(run.hdrf_se[view, 0]), 1)


def purist(section):
    text, files = discs(leaf(0.5, 0.5), lambertian(1))
    for sza in (0, 30, 60):
        run = simulate(text + light(sza, 70) + flux + sampling(16384, "roulette = false"), files)
        section.equal(f"purist canopy (rho = tau = 0.5, ground 1), sun at {sza}, forward: reflected flux", float(run.reflected[0]), 1, 1e-6)
    for sza in (0, 30, 60):
        run = simulate(text + light(sza, 70) + scenes.albedo + sampling(65536, "roulette = false"), files)
        section.compare(f"purist canopy, sun at {sza}, reverse: DHR", float(run.dhr[0, 0]), float(run.dhr_se[0, 0]), 1)


def balance(run, ground):
    """Absorbed + reflected + (1 - rho) transmitted + lost, by band."""
    return run.absorbed_canopy + run.reflected + (1 - ground) * run.transmitted + run.lost_wraps


def kinds():
    """Each kind of scene of this page: name, text, files, bands, ground reflectance."""
    text, files = discs(leaf("[[650, 0.1], [850, 0.45]]", "[[650, 0.06], [850, 0.35]]"), lambertian(0.25))
    yield "random discs, LAI 2", text, files, [650, 850], [0.25, 0.25]
    yield "bench_hom", scenes.bench_hom(scenes.bench_hom_leaf, scenes.bench_hom_soil), {}, [650, 850], [0.127, 0.159]
    yield "HET01", scenes.het01(), {}, [850], [0.159]
    bands = [550, 670, 850, 1650]
    yield "PROSPECT canopy", prospect.canopy(), prospect.files(), bands, [prospect.soil_at(nm) for nm in bands]


def fluxes(section):
    """Each photon closes by itself in one band without roulette. With several bands and roulette it is the mean that is 1; its
    error is that between eight seeds, since parts of one run are correlated."""
    rows, sums, pairs = [], [], []
    for name, text, files, bands, ground in kinds():
        light_text = light(35, 40) + "sky = { type = \"isotropic\", irradiance = 0.8 }\n"
        sensors = flux + scenes.albedo
        wavelengths = f"[bands]\nwavelengths_nm = {bands}\n"
        one = simulate(text + light_text + flux + f"[bands]\nwavelengths_nm = [{bands[-1]}]\n" + sampling(4096, "roulette = false"), files)
        section.equal(f"{name}, {bands[-1]} nm, sun and sky, no roulette: sum of the fluxes", float(balance(one, ground[-1])[0]), 1, 2e-6)
        draws = [simulate(text + light_text + flux + wavelengths + sampling(4096), files, seed) for seed in range(1, 9)]
        run = simulate(text + light(35, 40) + sensors + wavelengths + sampling(65536), files)
        for band, nm in enumerate(bands):
            mean, error = mean_of(float(balance(draw, ground[band])[band]) for draw in draws)
            sums.append((f"{name}, {nm} nm, all bands together: sum of the fluxes, eight seeds", mean, error, 1))
            pairs.append((f"{name}, {nm} nm: DHR (reverse) and reflected flux (forward)", float(run.dhr[0, band]),
                          float(run.dhr_se[0, band]), float(run.flux_reflected[band]), float(run.flux_reflected_se[band])))  # fmt: skip
            first = draws[0]
            rows.append((name, nm, *(f"{float(first[key][band]):.4f}" for key in ("absorbed_canopy", "reflected", "transmitted", "absorbed_ground"))))
    for entry in [*sums, *pairs]:
        section.compare(*entry)
    section.text("The fluxes of one of these runs each, under sun and sky (fractions of what enters; transmitted: each arrival at the ground):")
    section.table(("scene", "nm", "absorbed by the canopy", "reflected", "transmitted", "absorbed by the ground"), rows)


def validate(page):
    section = page.section("Energy", "White furnaces, the purist canopy of RAMI, and absorbed + reflected + (1 - rho) transmitted by the `flux` sensor.")
    furnaces(section)
    purist(section)
    fluxes(section)


