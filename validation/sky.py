"""The sky of Zibordi & Voss (1989) as a scene states it, against its limits and its equations evaluated here by themselves."""
import math

import pandas

import settings
from scenes import domain, lambertian, sampling, simulate, soil

sun_deg = 35


def sky(depth_rayleigh, depth_aerosol, extraterrestrial=1.0, albedo=0.0, more="", beta=True):
    """One band at 1 um, where the optical depths of air and aerosol are A and beta; no absorption but what `more` says."""
    return (f"[illumination.sky]\ntype = \"zibordi_voss\"\nextraterrestrial = {extraterrestrial}\nozone_absorption = 0\nwater_absorption = 0\n"
            f"gas_absorption = 0\nsurface_albedo = {albedo}\nrayleigh = [{depth_rayleigh}, 0, 0, 0]\n"
            f"aerosol = {{ alpha = 0, beta = {depth_aerosol}, single_scattering_albedo = 1 }}\n{more}")  # fmt: skip


def under(sky_text, sensors, samples, sun=sun_deg):
    return simulate(domain(2) + soil(lambertian(0)) + f'[illumination]\nsun = {{ zenith_deg = {sun}, azimuth_deg = 0, irradiance = "zibordi_voss" }}\n'
                    + sky_text + sensors + "[bands]\nwavelengths_nm = [1000]\n" + sampling(samples))  # fmt: skip


def looking(name, zenith, azimuth):
    """A camera of one ray that looks up."""
    z, a = math.radians(zenith), math.radians(azimuth)
    d = [math.sin(z) * math.sin(a), math.sin(z) * math.cos(a), math.cos(z)]
    return f'[[sensors]]\nname = "{name}"\ntype = "radiometer"\nlocation = [0, 0, 1]\ndirection = {d}\nfov_deg = 0\n'


def phase(psi_cosine, rayleigh, aerosol):
    def hg(g):
        return (1 - g * g) / (1 + g * g - 2 * g * psi_cosine) ** 1.5

    p_r, p_a = 0.75 * (1 + psi_cosine**2), 0.9618 * hg(0.713) + (1 - 0.9618) * hg(-0.7598)
    return (rayleigh * p_r + aerosol * p_a) / (rayleigh + aerosol)


def p1(rayleigh, aerosol, steps=4000):
    """1.5 times the integral of P cos sin."""
    width = math.pi / steps
    return 1.5 * sum(phase(math.cos(t), rayleigh, aerosol) * math.cos(t) * math.sin(t) for t in ((i + 0.5) * width for i in range(steps))) * width


def radiance(mu, psi_cosine, rayleigh, aerosol, albedo, first):
    """E0 = 1, no absorption: the equation of radiative_transfer.md, section 4."""
    mu0, scattering = math.cos(math.radians(sun_deg)), rayleigh + aerosol

    def r(x):
        return 1 + 1.5 * x + (1 - 1.5 * x) * math.exp(-scattering / x)

    once = 0.25 * (math.exp(-scattering / mu) - math.exp(-scattering / mu0)) / (mu - mu0)
    total = (((1 - albedo) * r(mu) + 2 * albedo) * r(mu0) / (4 + (3 - first) * (1 - albedo) * scattering)
             - 0.5 * (math.exp(-scattering / mu) + math.exp(-scattering / mu0))
             + (phase(psi_cosine, rayleigh, aerosol) - (3 + first) * mu * mu0) * once)  # fmt: skip
    return mu0 / math.pi * total


def cosine_to_sun(zenith, azimuth):
    s = math.radians(sun_deg)
    return math.cos(zenith) * math.cos(s) + math.sin(zenith) * math.sin(s) * math.cos(azimuth)


def single_scattering_limit(section):
    thin = 1e-5
    for name, air, aerosol in (("air", thin, 0.0), ("aerosol", 0.0, thin)):
        places = [(0, 0), (20, 90), (45, 0), (60, 180), (80, 90)]
        run = under(sky(air, aerosol, "1000000.0", more="zeniths = 181\nazimuths = 360\n"), "".join(looking(f"s{i}", *p) for i, p in enumerate(places)), 64)
        off = 0.0
        for i, (zenith, azimuth) in enumerate(places):
            z, a = math.radians(zenith), math.radians(azimuth)
            once = 1e6 * thin * phase(cosine_to_sun(z, a), air, aerosol) / (4 * math.pi * math.cos(z))
            off = max(off, abs(float(run[f"s{i}_radiance"][0, 0]) / once - 1))
        # What is scattered twice is of the order of the depth times 1 / mu.
        section.equal_by(f"thin {name} over black ground: L and E0 ts P / (4 pi mu) in {len(places)} directions", off, 20 * thin)


def diffuse_flux(section):
    rayleigh, aerosol, albedo = 0.1, 0.2, 0.25
    run = under(sky(rayleigh, aerosol, "1000.0", albedo),
                '[[sensors]]\nname = "up"\ntype = "radiometer"\nlocation = [0, 0, 1]\ndirection = [0, 0, 1]\ncosine = true\n', 262144)  # fmt: skip
    first, rows, columns = p1(rayleigh, aerosol), 450, 180
    flux = 0.0
    for i in range(rows):
        zenith = math.pi / 2 * (i + 0.5) / rows
        ring = sum(radiance(math.cos(zenith), cosine_to_sun(zenith, 2 * math.pi * (k + 0.5) / columns), rayleigh, aerosol, albedo, first) for k in range(columns))
        flux += 1000 * ring * math.cos(zenith) * math.sin(zenith) * (math.pi / 2 / rows) * (2 * math.pi / columns)
    # The map is linear between the points of its grid of 1 x 3 degrees.
    section.equal("diffuse flux (tR 0.1, tA 0.2, ground 0.25) and the hemispherical integral of the equations",
                  float(run.irradiance_by_origin.sel(origin="diffuse")[0, 0]), flux, 1e-3)  # fmt: skip


def sample(section):
    """The sample's columns 2, 4 and 10 give the sun's zenith; 7 is the optical depth, 8 the downward transmittance."""
    table = pandas.read_csv(settings.data / "sky/direct.total_irradiance.all", comment="#", sep=r"\s+", header=None)
    depth, transmittance = float(table[6][0]), float(table[7][0])
    cosine = float((table[3] * (100 / table[9] - 1) / table[1]).mean())
    run = under(sky(0, depth, "1000.0"), '[[sensors]]\nname = "up"\ntype = "radiometer"\nlocation = [0, 0, 1]\ndirection = [0, 0, 1]\ncosine = true\n', 4096,
                sun=math.degrees(math.acos(cosine)))  # fmt: skip
    direct = float(run.irradiance_by_origin.sel(origin="direct")[0, 0])
    # Six digits of transmittance, and the zenith of five of irradiance.
    section.equal("direct transmittance of the sample in `sky/`, optical depth 0.1", direct / (1000 * cosine), transmittance, 5e-6)


def validate(page):
    section = page.section("Sky model", "Zibordi & Voss 1989 as a scene states it, seen by radiometers that look up, against its single-scattering limit, its equations "
                           "evaluated by the page itself and integrated over the hemisphere, and the transmittance of a sample of its author's program (whose "
                           "other parameters are not recorded).")  # fmt: skip
    single_scattering_limit(section)
    sample(section)
    diffuse_flux(section)
