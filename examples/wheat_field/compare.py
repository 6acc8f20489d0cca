#!/usr/bin/env python3
"""Gap fraction of the canopies against the photographs.

    compare.py DATA FOLDER [OUT.svg]     reads FOLDER/{all,green}_DATE_SEED.json, writes FOLDER/comparison.csv
"""
import csv
import glob
import json
import math
import sys

import measurements as m

ANGLES = {"vertical": 0.0, "inclined": 57.5}


def mean_sd(values):
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) - 1)) if len(values) > 1 else math.nan


def modelled(folder, what, date, zenith):
    """Cover (1 - gap fraction, in percent) of the stands of all seeds, and the largest standard error of the rays."""
    covers, errors = [], []
    for path in sorted(glob.glob(f"{folder}/{what}_{date}_*.json")):
        with open(path) as report:
            gap = next(g for g in json.load(report)["gap_fraction"] if g["zenith_deg"] == zenith)
        covers.append(100 * (1 - gap["p"]))
        errors.append(100 * gap["standard_error"])
    return covers, max(errors)


def lai(folder, date):
    values = []
    for path in sorted(glob.glob(f"{folder}/all_{date}_*.json")):
        with open(path) as report:
            values.append(json.load(report)["lai"])
    return sum(values) / len(values)


def main(data, folder, picture=None):
    table = []
    print("                         photographs            model, all          model, green     bias")
    print("date       zenith  cover %  sd   n      cover %  sd  seeds      cover %  sd     all  green")
    for date, day in m.DATES.items():
        for kind, zenith in ANGLES.items():
            seen, seen_sd = mean_sd(m.photographs(data, date, kind))
            n = len(m.photographs(data, date, kind))
            row = {"date": day, "zenith_deg": zenith, "photographs": n, "cover_measured_percent": seen, "cover_measured_sd": seen_sd}
            for what in ("all", "green"):
                covers, ray_error = modelled(folder, what, date, zenith)
                mean, sd = mean_sd(covers)
                row |= {f"cover_{what}_percent": mean, f"cover_{what}_sd": sd, f"bias_{what}_percent": mean - seen,
                        "seeds": len(covers), f"ray_error_{what}": ray_error}
            table.append(row)
            print(f"{day} {zenith:6.1f}  {seen:6.1f} {seen_sd:5.1f} {n:3d}      {row['cover_all_percent']:6.1f} {row['cover_all_sd']:4.1f}"
                  f" {row['seeds']:4d}       {row['cover_green_percent']:6.1f} {row['cover_green_sd']:4.1f}"
                  f"   {row['bias_all_percent']:+5.1f}  {row['bias_green_percent']:+5.1f}")
        print(f"{day} LAI of the model {lai(folder, date):.2f}")
    with open(f"{folder}/comparison.csv", "w", newline="") as out:
        writer = csv.DictWriter(out, table[0].keys())
        writer.writeheader()
        writer.writerows({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()} for row in table)
    if picture:
        draw(table, picture)


def draw(table, path):
    from chart import Chart

    days = [0, 33, 61]  # after 9 March
    chart = Chart("Wheat, Boigneville 2012: cover seen in photographs and in the model", "days after 9 March 2012", "cover / %", height=420)
    for kind, zenith in ANGLES.items():
        rows = [row for row in table if row["zenith_deg"] == zenith]
        chart.points(f"photographs, {zenith:g} degrees (sd)", days, [r["cover_measured_percent"] for r in rows], [r["cover_measured_sd"] for r in rows])
        chart.line(f"model, {zenith:g} degrees", days, [r["cover_all_percent"] for r in rows])
        chart.line(f"model, green parts, {zenith:g} degrees", days, [r["cover_green_percent"] for r in rows], dashed=True)
    chart.write(path)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
