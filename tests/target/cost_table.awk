# Turns what cost_table.sh measured into Markdown. A line is: scalar core kind, then names with values.
function take(    i) {
    delete value
    for (i = 4; i < NF; i += 2) {
        value[$i] = $(i + 1)
    }
}
function at(core, scalar, plays, name) {
    return measured[core, scalar, plays, name]
}
# The largest over the numbers of plays.
function most(core, scalar, name,    i, x) {
    x = 0
    for (i = 1; i <= num_plays; ++i) {
        x = at(core, scalar, plays_of[i], name) > x ? at(core, scalar, plays_of[i], name) : x
    }
    return x
}
function pair(core, scalar, plays, what) {
    return at(core, scalar, plays, what "_smooth") " / " at(core, scalar, plays, what "_worst")
}
{
    take()
    if (!(($2, $1) in seen)) {
        seen[$2, $1] = ++num_rows
        row_core[num_rows] = $2
        row_scalar[num_rows] = $1
    }
    plays = $3 == "model" ? value["plays"] : $3
    if ($3 == "model" && !(plays in known)) {
        known[plays] = 1
        plays_of[++num_plays] = plays
    }
    if (!($1 in scalar_known)) {
        scalar_known[$1] = 1
        scalar_of[++num_scalars] = $1
        first_core[$1] = $2
    }
    for (name in value) {
        measured[$2, $1, plays, name] = value[name]
    }
}
END {
    print "Bytes of code (with what it needs of the compiler's own library) and of stack:"
    print ""
    print "| core | scalar | flash: forward | forward + inverse | all functions | stack: forward | inverse |"
    print "|---|---|---:|---:|---:|---:|---:|"
    for (r = 1; r <= num_rows; ++r) {
        core = row_core[r]
        scalar = row_scalar[r]
        printf "| %s | %s | %d | %d | %d | %d | %d |\n", core, scalar, at(core, scalar, "code", "part_1"),
            at(core, scalar, "code", "part_2"), at(core, scalar, "code", "part_3"),
            most(core, scalar, "forward_stack"), most(core, scalar, "inverse_stack")
    }
    print ""
    print "Bytes a model, flash (tables) / RAM (state and memory), the same on all cores:"
    print ""
    head = "| scalar |"
    rule = "|---|"
    for (i = 1; i <= num_plays; ++i) {
        head = head " N = " plays_of[i] " |"
        rule = rule "---:|"
    }
    print head
    print rule
    for (s = 1; s <= num_scalars; ++s) {
        scalar = scalar_of[s]
        line = "| " scalar " |"
        for (i = 1; i <= num_plays; ++i) {
            line = line " " at(first_core[scalar], scalar, plays_of[i], "tables") " / " \
                at(first_core[scalar], scalar, plays_of[i], "ram") " |"
        }
        print line
    }
    print ""
    print "Instructions a sample, counted under emulation (a count, never a time), smooth input / worst constructed input:"
    print ""
    head = "| core | scalar | step |"
    rule = "|---|---|---|"
    for (i = 1; i <= num_plays; ++i) {
        head = head " N = " plays_of[i] " |"
        rule = rule "---:|"
    }
    print head " 40 channels of N = " at(row_core[1], row_scalar[1], "channels", "plays") " |"
    print rule "---:|"
    for (r = 1; r <= num_rows; ++r) {
        core = row_core[r]
        scalar = row_scalar[r]
        forward = "| " core " | " scalar " | forward |"
        inverse = "| " core " | " scalar " | inverse |"
        for (i = 1; i <= num_plays; ++i) {
            forward = forward " " pair(core, scalar, plays_of[i], "forward") " |"
            inverse = inverse " " pair(core, scalar, plays_of[i], "inverse") " |"
        }
        print forward " " at(core, scalar, "channels", "forward_smooth") " |"
        print inverse " |"
    }
}
