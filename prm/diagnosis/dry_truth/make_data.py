#!/usr/bin/env python3
"""make_data.py SET...: from the dumps of runs.sh to ../dry_SET/measurements.csv and conditions.csv."""
import math, os, sys
from measure import angles, blocks, mean, spread

REPEATS, HELD_OUT = (1, 2, 3), [("0.004", 25), ("0.006", 40)]
conditions = [(d, rpm) for d in ("0.004", "0.006") for rpm in (10, 25, 40)]
name = lambda d, rpm: "%s mm %d rpm" % (d[-1], rpm)
RECORD = {"0.004": 3, "0.006": 6}  # s, after 1 s
BLOCK = 37  # frames of 0.04 s
sets = sys.argv[1:]

for s in sets:
    folder = os.path.join("..", "dry_" + s)
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "conditions.csv"), "w") as f:
        f.write("condition,held_out,Seeds/Diameter [mm],Drum/Speed [rpm],Drum/Revolutions [1],Drum/Plateau from [1]\n")
        for d, rpm in conditions:
            f.write("%s,%s,%s,%d,%.6g,%.6g\n" % (name(d, rpm), "yes" if (d, rpm) in HELD_OUT else "no", d[-1], rpm, (1 + RECORD[d]) * rpm / 60, rpm / 60))
    with open(os.path.join(folder, "measurements.csv"), "w") as f:
        f.write("# Plain spheres in a rotating drum, simulated with LAMMPS 29 Sep 2021; see ../dry_truth/README.md. Mean of three repeats;\n"
                "# standard uncertainty: of that mean, from the scatter of means over 1.5 s.\n"
                "condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty\n")
        runs = {c: [angles("%s_%s_%d_%d.dump" % (s, *c, r), float(c[0])) for r in REPEATS] for c in conditions}
        for column, quantity in enumerate(("surface angle", "centre of mass angle")):
            for d, rpm in conditions:
                v = [block for run in runs[d, rpm] for block in blocks(run[column], BLOCK)]
                f.write("%s,%s,deg,,,%.2f,%.2f\n" % (name(d, rpm), quantity, mean(v), spread(v) / math.sqrt(len(v))))
