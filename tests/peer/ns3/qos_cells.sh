#!/bin/sh
# The runs of {vht_he,ht_ampdu,ht_restart,edca_ht,edca_eifs}_ns3.csv, one command a line; in the folder of the peer programs:
#   sh qos_cells.sh vht_he | xargs -P 2 -I{} sh -c '{}'
# A station alone needs one seed, several need ten; with 20, MSDUs that wait in reorder buffers when the
# measurement begins count, unless it begins late. At 5 m, neighbours do not decode MCS 11 in 80 MHz.
# ns-3.37 sends HE at a guard interval of 1600 ns with 3200 ns, and ends some runs of A-MPDUs by "Invalid
# WifiPhy state": seeds from 11 on take their places.
alone() { echo "./qos_cells --seconds=2 $*"; }
several() {
  for seed in 1 2 3 4 5 6 7 8 9 10; do echo "./qos_cells --seed=$seed $*"; done
}
vht() { echo "--phy=ac --width=$1 --mcs=$2 --streams=$3 --guard=$4"; }
he() { echo "--phy=ax --width=$1 --mcs=$2 --streams=$3 --guard=$4"; }

vht_he() {
  for ampdu in 0 65535 1048575; do
    alone "$(vht 20 0 1 800)" --ampdu=$ampdu
    alone "$(vht 20 8 1 400)" --ampdu=$ampdu
    alone "$(vht 20 7 2 800)" --ampdu=$ampdu
    alone "$(vht 40 9 1 800)" --ampdu=$ampdu
    alone "$(vht 40 4 2 400)" --ampdu=$ampdu
    alone "$(vht 80 3 1 400)" --ampdu=$ampdu
    alone "$(vht 80 9 1 800)" --ampdu=$ampdu
    alone "$(vht 80 9 2 400)" --ampdu=$ampdu
    alone "$(he 20 0 1 800)" --ampdu=$ampdu
    alone "$(he 20 11 1 3200)" --ampdu=$ampdu
    alone "$(he 20 5 2 3200)" --ampdu=$ampdu
    alone "$(he 40 7 1 800)" --ampdu=$ampdu
    alone "$(he 80 4 1 3200)" --ampdu=$ampdu
    alone "$(he 80 11 1 800)" --ampdu=$ampdu
    alone "$(he 80 11 2 3200)" --radius=1 --ampdu=$ampdu
  done
  for ampdu in 0 1048575; do
    alone "$(vht 20 7 2 800)" --ampdu=$ampdu --amsdu=7935
    alone "$(vht 80 9 2 400)" --ampdu=$ampdu --amsdu=7935
    alone "$(he 80 11 1 800)" --ampdu=$ampdu --amsdu=7935
  done
  alone --phy=n --width=40 --mcs=7 --streams=2 --guard=400
  alone --phy=n --width=40 --mcs=7 --streams=2 --guard=400 --ampdu=65535

  alone "$(vht 20 7 1 800)" --txop_be=2528
  alone "$(vht 80 9 1 800)" --txop_be=2528
  alone "$(vht 20 7 1 800)" --txop_be=2528 --ampdu=1048575
  alone "$(he 20 11 1 800)" --txop_be=2528
  alone "$(he 80 11 1 800)" --txop_be=2528 --ampdu=1048575
  alone "$(vht 20 7 1 800)" --be=0 --vi=1 --txop_vi=3008
  alone "$(he 80 11 1 800)" --be=0 --vi=1 --txop_vi=3008 --ampdu=1048575
  several "$(vht 20 7 1 800)" --txop_be=2528 --be=5 --seconds=4
  several "$(he 80 11 1 800)" --txop_be=2528 --be=5 --seconds=4 --radius=1 --ampdu=1048575

  several "$(vht 20 7 2 800)" --be=5 --seconds=4
  several "$(vht 20 7 2 800)" --be=5 --seconds=8 --ampdu=1048575
  several "$(vht 40 4 2 400)" --be=5 --seconds=4
  several "$(vht 40 4 2 400)" --be=5 --seconds=6 --ampdu=65535
  several "$(vht 80 9 1 800)" --be=5 --seconds=3
  several "$(vht 80 9 1 800)" --be=5 --seconds=4 --ampdu=1048575
  several "$(vht 80 9 2 400)" --be=5 --seconds=3 --amsdu=7935
  several "$(he 20 11 1 3200)" --be=5 --seconds=4 --radius=1
  several "$(he 20 11 1 3200)" --be=5 --seconds=6 --radius=1 --ampdu=1048575
  several "$(he 20 5 2 3200)" --be=5 --seconds=6 --ampdu=65535
  several "$(he 80 11 1 800)" --be=5 --seconds=3 --radius=1
  several "$(he 80 11 1 800)" --be=5 --seconds=4 --radius=1 --ampdu=1048575
  several --phy=n --width=40 --mcs=7 --streams=2 --guard=400 --be=5 --seconds=3
  several --phy=n --width=40 --mcs=7 --streams=2 --guard=400 --be=5 --seconds=5 --ampdu=65535
  several "$(vht 20 8 1 400)" --be=20 --warm=3 --seconds=4
  several "$(vht 40 9 1 800)" --be=20 --seconds=10 --ampdu=65535
  several "$(vht 80 9 2 400)" --be=20 --seconds=6 --radius=1 --ampdu=65535
  several "$(he 20 5 2 3200)" --be=20 --warm=3 --seconds=4 --preamble=20
  several "$(he 20 5 2 3200)" --be=20 --seconds=10 --ampdu=65535
}

# 802.11n of 2.4 GHz; the last without EIFS, because no preamble is detected in a collision (--preamble=20).
ht_ampdu() {
  for mcs in 0 7; do
    several --phy=n --band=2.4 --mcs=$mcs --be=5 --seconds=10 --ampdu=65535
    several --phy=n --band=2.4 --mcs=$mcs --be=5 --seconds=10 --ampdu=65535 --size=200
  done
  several --phy=n --band=2.4 --mcs=7 --be=5 --seconds=3 --size=200 --preamble=20
}

# Voice of 200 bytes 50 times a second, or saturated with the TXOP limit 0, beside best effort.
edca_ht() {
  for ampdu in 0 65535; do
    n="--phy=n --band=2.4 --mcs=7 --be=5 --vo=5 --seconds=4 --ampdu=$ampdu"
    several "$n" --vo_size=200 --vo_rate=50 --txop_vo=0
    several "$n" --txop_vo=0
  done
}

# The cell of short frames with an EIFS, which differs most.
ht_restart() { several --phy=n --band=2.4 --mcs=7 --be=5 --seconds=3 --size=200 --restart; }

# The A-MPDUs of edca_ht without what ns-3.37 does to EIFS and to MPDUs behind one that was given up.
edca_eifs() {
  n="--phy=n --band=2.4 --mcs=7 --be=5 --vo=5 --ampdu=65535 --txop_vo=0 --restart"
  several "$n" --seconds=30
  several "$n" --seconds=20 --vo_size=200 --vo_rate=50 --unordered
}

"$1"
