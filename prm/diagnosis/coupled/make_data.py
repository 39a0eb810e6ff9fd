#!/usr/bin/env python3
"""make_data.py: measurements.csv and conditions.csv of the coupled case. Hidden: the sub-spheres of a seed share one drag.
Made with other numerics than the model's: cells of 3 mm instead of 4, half the air step, 70 sub-spheres instead of 36.
Run in this folder: python3 make_data.py"""
import csv, os, random, subprocess, tempfile

HIDDEN = ["Coupling/Drag on=seed", "Air domain/Cells=8, 8, 16", "Run/Air step=2 ms", "Run/Series interval=2 ms",
          "Seeds/Sub-spheres=70", "Seeds motion/Time step=2e-6 s"]
CONDITIONS = [("thin", "no", 0.05, 1340), ("thick", "no", 0.2, 1340), ("thick and heavy", "no", 0.2, 1800),
              ("heavy", "yes", 0.1, 1800), ("medium", "yes", 0.1, 1340)]
TIMES, NOISE = [0.02, 0.04, 0.06, 0.08, 0.1], 0.02
PROGRAM = os.environ.get("SEEDFLOW", "../../../seedflow")

random.seed(4)
with open("conditions.csv", "w") as conditions, open("measurements.csv", "w") as data:
    conditions.write("condition,held_out,Air/Dynamic viscosity [Pa s],Seeds/Density [kg/m3]\n")
    data.write("# A seed sinking through a resolved liquid, made by make_data.py with noise of 2 % of the largest speed.\n"
               "condition,quantity,unit,coordinate,coordinate_unit,value,standard_uncertainty\n")
    for name, held_out, viscosity, density in CONDITIONS:

        conditions.write("%s,%s,%g,%g\n" % (name, held_out, viscosity, density))
        with tempfile.TemporaryDirectory() as folder:
            command = [PROGRAM, "run", "model.prm", "--output", folder]
            for entry in HIDDEN + ["Air/Dynamic viscosity=%g" % viscosity, "Seeds/Density=%g" % density]:
                command += ["--set", entry]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
            rows = list(csv.DictReader(open(os.path.join(folder, "seeds.csv"))))
        speed = lambda t: -float(min(rows, key=lambda r: abs(float(r["time [s]"]) - t))["velocity z [m/s]"])
        sigma = NOISE * max(speed(t) for t in TIMES)
        for t in TIMES:
            data.write("%s,velocity,m/s,%g,s,%.5g,%.2g\n" % (name, t, speed(t) + random.gauss(0, sigma), sigma))
