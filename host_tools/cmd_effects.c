#include "command.h"
#include "effect.h"
#include <float.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>

static const char* stage_name(effect_stage_t stage)
{
    static const char* const names[] = {[EFFECT_DRIVE] = "drive",
                                        [EFFECT_HYSTERESIS] = "hysteresis",
                                        [EFFECT_BODY] = "body",
                                        [EFFECT_SENSOR] = "sensor"};
    return names[stage];
}

static const char symbols[] = "Symbols: v the input on its way to the plays, y the output on its way from "
                              "them, v' and y' the same behind the "
                              "effect;\n"
                              "t the time, t0 the record's first; w_j and r_j output and radius of play j, "
                              "r_N the largest radius; S the plays' "
                              "weighted\n"
                              "sum, dS its change, S_m and S_h middle and half of its span between the "
                              "saturations; level(v) from -1 to 1 over "
                              "the model's\n"
                              "input range, v_m and half_range that range's middle and half; y_m and "
                              "half_span middle and half of the model's "
                              "output between\n"
                              "the saturations, m(v) the middle of its major loop; spans the input's travel "
                              "since the record's start in widths "
                              "of the model's\n"
                              "input range, s the same with each move counted (how fast it is / "
                              "speed)^speed_power times; c the auxiliary column "
                              "named by\n"
                              "\"column\", without the white noise of its sensor, counted from "
                              "\"reference\" (left out: from the record's first "
                              "value); LP a lag of first order, LP_k "
                              "six of them evenly\n"
                              "in the logarithm from tau_fast to tau_slow.\n";

static void print_range(const effect_parameter_t* parameter)
{
    if (parameter->least <= -DBL_MAX) {
        fputs("any", stdout);
    } else if (parameter->most < DBL_MAX) {
        printf("%g ... %g", parameter->least, parameter->most);
    } else if (parameter->least > 0) {
        fputs("above 0", stdout);
    } else {
        printf("%g or more", parameter->least);
    }
    puts(parameter->optional ? ", 0 when left out" : "");
}

/// Length of the name up to a number at its end; the whole name without one.
static size_t stem_length(const char* name)
{
    const size_t stem = strcspn(name, "0123456789");
    return name[stem] != '\0' && name[stem + strspn(&name[stem], "0123456789")] == '\0' ? stem : strlen(name);
}

/// Whether both are of one numbered row (node_1, node_2).
static bool is_same_row(const effect_parameter_t* a, const effect_parameter_t* b)
{
    const size_t stem = stem_length(a->name);
    return a->name[stem] != '\0' && stem_length(b->name) == stem && strncmp(a->name, b->name, stem) == 0 &&
           a->optional == b->optional;
}

static void print_parameters(const effect_t* effect)
{
    for (size_t p = 0, next; p < effect->num_parameters; p = next) {
        const effect_parameter_t* first = &effect->parameter[p];
        for (next = p + 1; next < effect->num_parameters && is_same_row(first, &effect->parameter[next]);) {
            next++;
        }
        char name[64];
        (void)snprintf(name, sizeof name, next > p + 1 ? "%s ... %s" : "%s", first->name,
                       effect->parameter[next - 1].name);
        printf("      %-20s [%s] ", name, first->unit);
        print_range(first);
    }
}

static void print_law(const char* law)
{
    for (; *law != '\0'; law += *law == '\n') {
        const size_t length = strcspn(law, "\n");
        printf("    %.*s\n", (int)length, law);
        law += length;
    }
}

static void print_effect(const effect_t* effect, bool is_first)
{
    if (is_first) {
        printf("%s: %s\n", effect->name, effect->what);
    }
    printf("  ");
    if (effect->mechanism != NULL) {
        printf("\"mechanism\": \"%s\", ", effect->mechanism);
    }
    printf("%s%s\n", stage_name(effect->stage),
           effect->transferable ? "" : ", holds for its own record alone");
    print_law(effect->law);
    print_parameters(effect);
    if (effect->no_inverse != NULL) {
        printf("    no inverse: %s\n", effect->no_inverse);
    }
}

static void print_text(void)
{
    const char* last = "";
    for (size_t i = 0; i < effect_count(); i++) {
        const effect_t* effect = effect_at(i);
        const bool is_first = strcmp(effect->what, last) != 0;
        printf("%s", is_first && i > 0 ? "\n" : "");
        print_effect(effect, is_first);
        last = effect->what;
    }
    printf("\n%s", symbols);
}

/// A bound that is none is left out.
static json_t* parameter_json(const effect_parameter_t* parameter)
{
    json_t* object = json_pack("{s:s, s:s, s:b}", "name", parameter->name, "unit", parameter->unit,
                               "optional", parameter->optional);
    if (parameter->least > -DBL_MAX) {
        json_object_set_new(object, "least", json_real(parameter->least));
    }
    if (parameter->most < DBL_MAX) {
        json_object_set_new(object, "most", json_real(parameter->most));
    }
    return object;
}

static json_t* effect_json(const effect_t* effect)
{
    json_t* object = json_pack("{s:s}", "type", effect->name);
    if (effect->mechanism != NULL) {
        json_object_set_new(object, "mechanism", json_string(effect->mechanism));
    }
    json_object_set_new(object, "what", json_string(effect->what));
    json_object_set_new(object, "law", json_string(effect->law));
    json_object_set_new(object, "stage", json_string(stage_name(effect->stage)));
    json_object_set_new(object, "needs_column", json_boolean(effect->needs_column));
    json_object_set_new(object, "transferable", json_boolean(effect->transferable));
    json_object_set_new(object, "invertible", json_boolean(effect->no_inverse == NULL));
    json_t* parameters = json_array();
    for (size_t p = 0; p < effect->num_parameters; p++) {
        json_array_append_new(parameters, parameter_json(&effect->parameter[p]));
    }
    json_object_set_new(object, "parameters", parameters);
    return object;
}

static void print_json(void)
{
    json_t* list = json_array();
    for (size_t i = 0; i < effect_count(); i++) {
        json_array_append_new(list, effect_json(effect_at(i)));
    }
    (void)json_dumpf(list, stdout, JSON_INDENT(1) | JSON_REAL_PRECISION(9));
    puts("");
    json_decref(list);
}

outcome_t cmd_effects(int argc, const char** argv)
{
    static const command_t command = {
        "effects", "", 0,
        "Lists every effect of model files and diagnoses: what it is, its mechanisms, their equations and "
        "their "
        "parameters with\n"
        "units and physical ranges. Those of the drive run first, then hysteresis, body and sensor, within "
        "each in "
        "this order.\n"
        "\"unknown\" is what a diagnosis alone may find: no model file holds it."};
    int json = 0;
    const struct poptOption options[] = {
        {"json", 0, POPT_ARG_NONE, &json, 0, "a list of objects for programs", NULL}, POPT_TABLEEND};
    bool finished;
    const outcome_t outcome = command_parse(&command, options, argc, argv, NULL, &finished);
    if (outcome != OUTCOME_OK || finished) {
        return outcome;
    }
    if (json != 0) {
        print_json();
    } else {
        print_text();
    }
    return OUTCOME_OK;
}
