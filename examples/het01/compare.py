#!/usr/bin/env python3
"""Chi-square of a simulated principal plane against the reference, both errors taken in."""
import csv
import math
import sys

ours = {}
with open(sys.argv[1]) as table:
    for row in csv.DictReader(table):
        if row["quantity"] == "brf" and row["component"] == "all" and row["order"] == "" and row["origin"] == "total":
            ours[float(row["vza_deg"])] = (float(row["value"]), float(row["standard_error"]))
chi2 = 0.0
worst = (0.0, 0.0)
with open(sys.argv[2]) as table:
    rows = list(csv.DictReader(line for line in table if not line.startswith("#")))
for row in rows:
    vza, brf = float(row["vza_deg"]), float(row["brf"])
    reference_se = math.sqrt(float(row["radiance_var"])) * brf / float(row["radiance"])
    value, se = ours[vza]
    z = (value - brf) / math.hypot(se, reference_se)
    chi2 += z * z
    worst = max(worst, (abs(z), vza))
n = len(rows)
limit = n * (1 - 2 / (9 * n) + 2.326 * math.sqrt(2 / (9 * n))) ** 3
print(f"chi-square {chi2:.1f} over {n} views (1 % of chance: {limit:.1f}); largest |z| {worst[0]:.2f} at vza {worst[1]}")
sys.exit(0 if chi2 < limit else 5)
