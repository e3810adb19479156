# awk -v plays=N -f cost_model.awk: the VO2 film of the paper (Table 6) with N plays, as a model file.
BEGIN {
    printf "{\"format\": \"hyst-model\", \"version\": 1, \"name\": \"film with %d plays\",\n", plays
    print " \"input\": {\"unit\": \"degC\", \"min\": 30, \"max\": 90}, \"output\": {\"unit\": \"-log10(ohm)\"},"
    print " \"ascending\": {\"type\": \"tanh\", \"slope\": 0.16, \"shift\": -10.26},"
    print " \"descending\": {\"type\": \"tanh\", \"slope\": 0.201, \"shift\": -11.58},"
    print " \"nonhysteretic\": {\"type\": \"tanh\", \"slope\": 0.03, \"shift\": -1.61, \"offset\": -3.26},"
    # Even radii that all move; alternating weights, of the same sum for any number of plays.
    for (j = 0; j < plays; ++j) {
        radii = radii sprintf("%s%.15g", j > 0 ? ", " : "", 0.03 + 0.94 * j / (plays - 1))
        weights = weights sprintf("%s%.15g", j > 0 ? ", " : "", (j % 2 == 0 ? 1.2 : 0.8) / plays)
    }
    printf " \"radii\": [%s],\n \"weights\": [%s]}\n", radii, weights
}
