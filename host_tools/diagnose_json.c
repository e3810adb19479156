#include "diagnose_json.h"

#include "diagnose_shrink.h"

/// A cause's effects by name; an exogenous one with its column.
static json_t* names_of_uses(const effect_use_t* uses, size_t num_uses)
{
    json_t* names = json_array();
    for (size_t i = 0; i < num_uses; i++) {
        const effect_use_t* use = &uses[i];
        json_array_append_new(names, use->column[0] != '\0'
                                         ? json_sprintf("%s:%s", use->effect->name, use->column)
                                         : json_string(use->effect->name));
    }
    return names;
}

static json_t* names_of(const hypothesis_t* hypothesis)
{
    return names_of_uses(hypothesis->use, hypothesis->num_uses);
}

static bool is_transferable(const hypothesis_t* hypothesis)
{
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        if (!hypothesis->use[i].effect->transferable) {
            return false;
        }
    }
    return true;
}

static json_t* region_json(const region_t* region)
{
    json_t* object = json_pack("{s:s}", "axis", where_axis_name(region->axis));
    if (region->axis == AXIS_DIRECTION) {
        json_object_set_new(object, "value",
                            json_string(region->from > 0   ? "ascending"
                                        : region->from < 0 ? "descending"
                                                           : "holding"));
    } else {
        json_object_set_new(object, "from", json_real(region->from));
        json_object_set_new(object, "to", json_real(region->to));
    }
    json_object_set_new(object, "share", json_real(region->share));
    json_object_set_new(object, "lift", json_real(region->lift));
    json_object_set_new(object, "share_low", json_real(region->share_low));
    json_object_set_new(object, "share_high", json_real(region->share_high));
    return object;
}

json_t* parameters_to_json(const effect_use_t* uses, size_t num_uses)
{
    json_t* list = json_array();
    for (size_t i = 0; i < num_uses; i++) {
        json_array_append_new(list, effect_use_to_json(&uses[i]));
    }
    return list;
}

static json_t* cause_json(const cause_t* cause)
{
    json_t* object =
        json_pack("{s:o, s:f, s:f, s:f, s:f, s:f}", "effects", names_of(cause->hypothesis), "probability",
                  cause->probability, "rmse_after", cause->rmse_after, "shrink", cause->shrink, "shrink_low",
                  cause->shrink_low, "shrink_high", cause->shrink_high);
    json_object_set_new(object, "rmse_judged", json_real(cause->hypothesis->fit_rmse));
    json_object_set_new(object, "parameters",
                        parameters_to_json(cause->hypothesis->use, cause->hypothesis->num_uses));
    if (!is_transferable(cause->hypothesis)) {
        json_object_set_new(object, "transferable", json_false());
    }
    return object;
}

static json_t* verdict_effects(const diagnosis_t* d)
{
    return d->is_unknown ? json_pack("[s]", "unknown") : names_of(d->cause[0].hypothesis);
}

static json_t* verdict_json(const diagnosis_t* d)
{
    json_t* sets = json_array();
    for (size_t k = 0; k < d->num_indistinguishable; k++) {
        json_array_append_new(sets, names_of(d->cause[d->indistinguishable[k]].hypothesis));
    }
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    const size_t num_uses = diagnosis_handed_out(d, uses);
    return json_pack("{s:o, s:b, s:o, s:s, s:o}", "effects", verdict_effects(d), "confident", d->confident,
                     "indistinguishable", sets, "advice", d->advice, "augmented_with",
                     names_of_uses(uses, num_uses));
}

static json_t* gap_json(const diagnosis_t* d)
{
    return json_pack("{s:I, s:I, s:I, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "samples",
                     (json_int_t)d->num_samples, "samples_judged", (json_int_t)d->num_judged, "first_judged",
                     (json_int_t)d->scope.first_judged, "beyond_calibration", d->scope.beyond, "unvisited",
                     d->scope.unvisited, "rmse", d->rmse, "relative", d->relative, "noise", d->noise,
                     "noise_floor", d->noise_floor, "closable", d->closable);
}

json_t* diagnosis_to_json(const diagnosis_t* d)
{
    json_t* where = json_array();
    for (size_t i = 0; i < d->num_regions; i++) {
        json_array_append_new(where, region_json(&d->region[i]));
    }
    json_t* causes = json_array();
    for (size_t k = 0; k < d->num_causes; k++) {
        json_array_append_new(causes, cause_json(&d->cause[k]));
    }
    return json_pack("{s:s, s:i, s:o, s:o, s:o, s:o}", "format", "hyst-diagnosis", "version", 1, "gap",
                     gap_json(d), "where", where, "causes", causes, "verdict", verdict_json(d));
}

json_t* budget_to_json(const budget_t* budget)
{
    json_t* list = json_array();
    for (size_t i = 0; i < BUDGET_PARTS; i++) {
        const budget_entry_t* entry = &budget->entry[i];
        json_array_append_new(list, json_pack("{s:s, s:f, s:f}", "part", budget_part_name(entry->part),
                                              "rmse", entry->rmse, "share", entry->share));
    }
    return list;
}
