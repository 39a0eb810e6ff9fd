#!/bin/sh
# Three data sets, three speeds, two sizes, three repeats: dumps of every run. Few large spheres fluctuate more: 6 s, not 3.
set -e
run() { # set mu_r gamma
  for d in 0.004 0.006; do [ $d = 0.004 ] && n=75000 || n=150000; for r in 1 2 3; do
    [ -f start_${d}_$r.data ] || python3 start.py $d $r start_${d}_$r.data
    for rpm in 10 25 40; do
      out=$1_${d}_${rpm}_$r.dump
      [ -f $out.done ] || { lmp -in drum.in -var e 0.367 -var rpm $rpm -var start start_${d}_$r.data -var mu_r $2 -var gamma $3 -var n $n -var out $out -log none > $out.log 2>&1 && touch $out.done; }
    done
  done; done
}
run null 0 0
run rolling 0.12 0
run cohesion 0 0.05
