#!/bin/sh
# vo2_film_record.sh HYST: a record of the VO2 film on stdout, as a thermal bench would give it: the temperature swept
# in loops of shrinking size, one sample each 5 s, the output with noise of 0.005 (standard deviation) on it.
# Envelopes and non-hysteretic part: Zhang et al. 2015, Table 6. The weights are ours (the paper only plots them).
set -eu
hyst=$1
here=$(dirname "$0")

# Triangles between the turning points, 0.6 degrees a sample.
awk 'BEGIN {
    count = split("30 90 30 86 33 82 36 79 39 76 42 73 45 70 48 67 51 64 54 61 30 90 52 75 40 68 58 90 30", turn, " ")
    print "time,input"
    value = turn[1]; sample = 0
    printf "%d,%.4f\n", 0, value
    for (i = 2; i <= count; i++) {
        while (value != turn[i]) {
            step = turn[i] > value ? 0.6 : -0.6
            left = turn[i] - value
            value = (left < 0 ? -left : left) <= 0.6 + 1e-9 ? turn[i] : value + step
            printf "%d,%.4f\n", ++sample * 5, value
        }
    }
}' | "$hyst" simulate "$here/vo2_film.json" - -o - |
    # Noise: the sum of 12 uniform numbers less 6 has variance 1; the generator is Park and Miller`s, the same everywhere.
    awk -F, 'NR == 1 { print; next } {
        sum = -6
        for (i = 0; i < 12; i++) { seed = (seed ? seed : 20150757) * 16807 % 2147483647; sum += seed / 2147483647 }
        printf "%s,%s,%.6f\n", $1, $2, $3 + 0.005 * sum
    }'
