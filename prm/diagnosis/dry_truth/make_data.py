#!/usr/bin/env python3
"""make_data.py: from the dumps of runs.sh to ../dry_SET/measurements.csv and conditions.csv."""
import math, os
from measure import measure

REPEATS, HELD_OUT = (1, 2, 3), [("0.004", 25), ("0.006", 40)]
conditions = [(d, rpm) for d in ("0.004", "0.006") for rpm in (10, 25, 40)]
name = lambda d, rpm: "%s mm %d rpm" % (d[-1], rpm)
mean = lambda v: sum(v) / len(v)
sets = ("null", "rolling", "cohesion")
runs = {(s, d, rpm): [measure("%s_%s_%d_%d.dump" % (s, d, rpm, r), float(d)) for r in REPEATS] for s in sets for d, rpm in conditions}

for s in sets:
    folder = os.path.join("..", "dry_" + s)
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "conditions.csv"), "w") as f:
        f.write("condition,held_out,Seeds/Diameter [mm],Drum/Speed [rpm],Drum/Revolutions [1],Drum/Plateau from [1]\n")
        for d, rpm in conditions:
            f.write("%s,%s,%s,%d,%.6g,%.6g\n" % (name(d, rpm), "yes" if (d, rpm) in HELD_OUT else "no", d[-1], rpm, 3 * rpm / 60, rpm / 60))
    with open(os.path.join(folder, "measurements.csv"), "w") as f:
        f.write("# Plain spheres in a rotating drum, simulated with LAMMPS 29 Sep 2021; see ../dry_truth/README.md. Mean of three repeats;\n"
                "# standard uncertainty: of that mean, from the scatter of repeats pooled over the six conditions.\n"
                "condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty\n")
        for column, quantity in ((0, "surface angle"), (2, "centre of mass angle")):
            pooled = 0
            for d, rpm in conditions:
                v = [r[column] for r in runs[s, d, rpm]]
                pooled += sum((a - mean(v)) ** 2 for a in v) / (len(v) - 1) / len(conditions)
            for d, rpm in conditions:
                v = [r[column] for r in runs[s, d, rpm]]
                f.write("%s,%s,deg,,,%.2f,%.2f\n" % (name(d, rpm), quantity, mean(v), math.sqrt(pooled / len(v))))
