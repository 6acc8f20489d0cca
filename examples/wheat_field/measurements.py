"""The measured plants of one date, from the tables of wheat-echap: scanned blades, clicked midribs, stem diameters.

Lengths in cm. Blades are scanned flat: their widths stand at 21 places from the tip (w0.00) to the base (w1.00). Midribs are
clicked on photographs of a plant held in the plane of its blades, from the base of each blade.
"""
import csv
import math
from dataclasses import dataclass, field

DATES = {"090312": "09/03/2012", "110412": "11/04/2012", "090512": "09/05/2012"}
STATIONS = 21


@dataclass
class Blade:
    length: float
    widths: list  # from the base to the tip
    senescent: float  # part of the area

    @property
    def area(self):
        return self.length * sum((a + b) / 2 for a, b in zip(self.widths, self.widths[1:])) / (STATIONS - 1)


@dataclass
class Plant:
    name: str
    blades: dict = field(default_factory=dict)  # of the main stem, by rank from the base
    tiller_blades: list = field(default_factory=list)
    midribs: dict = field(default_factory=dict)  # of the main stem by rank: [(x, z)] from the blade's base
    heights: dict = field(default_factory=dict)  # of the blades' bases above the foot of the stem


def number(text):
    try:
        return float(text.replace(",", "."))
    except (ValueError, AttributeError):
        return math.nan


def rows(path, delimiter):
    with open(path, encoding="latin1", newline="") as table:
        return list(csv.DictReader(table, delimiter=delimiter))


def blade(row):
    length, widest = number(row["lmax"]), number(row["wmax"])
    widths = [number(row[f"w{k / (STATIONS - 1):.2f}"]) for k in reversed(range(STATIONS))]
    if not (length > 0 and widest > 0) or any(math.isnan(w) for w in widths):
        return None
    area, green = number(row["A_bl"]), number(row["A_bl_green"])
    # A few stations are wider than the blade's largest width: crumbs or a neighbour on the scanner.
    return Blade(length, [min(w, widest) for w in widths], min(1.0, max(0.0, 1 - green / area)) if area > 0 else 0.0)


def read_plants(folder, date):
    """All plants with a scanned main stem, in their order; a list of what was left out."""
    tables, notes, plants = f"{folder}/architectural_measurements", [], {}
    unread = 0
    for row in rows(f"{tables}/Tremie12_scan_sampled_plants_{date}.txt", "\t"):
        name = str(int(number(row["plant"])))
        found = blade(row)
        if found is None:
            unread += 1
            continue
        plant = plants.setdefault(name, Plant(name))
        rank = number(row["rank"])
        if math.isnan(rank):
            plant.tiller_blades.append(found)
        else:
            plant.blades[int(rank)] = found
    if unread:
        notes.append(f"{unread} scans without length or widths")
    read_midribs(f"{tables}/Tremie12_curvature_sampled_plants_{date}.csv", plants)
    return [p for p in plants.values() if p.blades], notes


def read_midribs(path, plants):
    lines = {}
    for row in rows(path, ";"):
        points = [number(row[f"Pt{k}"]) for k in range(1, 19)]
        lines.setdefault((row["ID_Plant"], int(row["ID_Metamer"])), {})[row["XY"]] = points
    for (name, rank), line in lines.items():
        foot = lines.get((name, 0))
        if name not in plants or rank == 0 or "0" not in line or "1" not in line or foot is None or "1" not in foot:
            continue
        points = [(x, z) for x, z in zip(line["0"], line["1"]) if x == x and z == z]
        ground = min(z for z in foot["1"] if z == z)
        if len(points) < 2 or points[0][1] <= ground:
            continue
        side = 1 if points[-1][0] >= points[0][0] else -1
        plants[name].midribs[rank] = [(side * x, z) for x, z in points]
        plants[name].heights[rank] = points[0][1] - ground


def stem_diameter(folder):
    """Of main stems on 9 May, the first date that has diameters."""
    table = rows(f"{folder}/architectural_measurements/Tremie12_notations_sampled_plants_090512.txt", "\t")
    values = [number(row["Daxe_mm"]) for row in table if row["axe"] == "MB"]
    values = [v for v in values if v == v]
    return sum(values) / len(values) / 10


def collar_ratio(folder):
    """Height of the tillers' last collar over the main stem's, on 9 May."""
    table = rows(f"{folder}/architectural_measurements/Tremie12_notations_sampled_plants_090512.txt", "\t")
    main = [number(r["Hcol"]) for r in table if r["axe"] == "MB"]
    tillers = [number(r["Hcol"]) for r in table if r["axe"].startswith("T")]
    mean = lambda values: sum(v for v in values if v == v) / sum(v == v for v in values)
    return mean(tillers) / mean(main)


def plot(folder):
    """Density by date (plants per square metre, the nearest count) and the distance between rows (m)."""
    with open(f"{folder}/PLOT-METADATA.csv", newline="") as table:
        row = next(r for r in csv.DictReader(table) if r["plot"] == "Tremie12")
    counts = {}
    for part in row["plant_density_m2_by_date"].split():
        if ":" in part:
            day, count = part.split(":")
            counts[day] = float(count)
    days = {"090312": "2012-03-20", "110412": "2012-04-11", "090512": "2012-05-09"}
    return {date: counts[day] for date, day in days.items()}, float(row["inter_row_m"])


def photographs(folder, date, kind):
    """Vegetation in percent of the pictures of one date; kind: vertical or inclined (57.5 degrees)."""
    table = rows(f"{folder}/canopy_data/Tremie12_{kind}_images.csv", ";")
    return [number(row["pcent_veg"]) for row in table if row["date"] == DATES[date]]
