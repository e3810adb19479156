#include "diagnose_text.h"

#include "diagnose_shrink.h"
#include <stdio.h>
#include <string.h>

void text_names(const hypothesis_t* hypothesis, char* text, size_t size)
{
    (void)snprintf(text, size, "%s", hypothesis->num_uses == 0 ? "nothing beside noise" : "");
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        const effect_use_t* use = &hypothesis->use[i];
        const size_t length = strlen(text);
        (void)snprintf(text + length, size - length, "%s%s%s%s", i > 0 ? " + " : "", use->effect->name,
                       use->column[0] != '\0' ? ":" : "", use->column);
    }
}

/// What an unknown gap looks like, as the end of a sentence.
static const char* looks_of(const diagnosis_t* diagnosis)
{
    const char* outside = hypothesis_outside(diagnosis->cause[0].hypothesis);
    return outside != NULL ? outside : "";
}

void text_verdict(const diagnosis_t* diagnosis, char* text, size_t size)
{
    if (diagnosis->is_unknown) {
        const char* looks = looks_of(diagnosis);
        (void)snprintf(text, size, "unknown: no named effect explains it%s%s",
                       looks[0] != '\0' ? "; it looks like " : "", looks);
    } else {
        text_names(diagnosis->cause[0].hypothesis, text, size);
    }
}

/// What the shrink of these effects is expected on.
static const char* outlook_of(const effect_use_t* uses, size_t count)
{
    bool is_bound = false;
    for (size_t i = 0; i < count; i++) {
        is_bound = is_bound || uses[i].is_of_one_record;
    }
    return is_bound ? "other stretches of this record" : "another record";
}

/// How far modelling a cause takes the data that it holds for.
static void describe_outlook(const cause_t* cause, char* text, size_t size)
{
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    const size_t count = cause_handed_out(cause, uses);
    if (count == 0) {
        (void)snprintf(text, size, "Modelling it is not expected to help on another record.");
        return;
    }
    (void)snprintf(text, size,
                   "Modelling %s is predicted to shrink the error of %s by %.0f %% (90 %% interval "
                   "%.0f to %.0f %%).",
                   count < cause->hypothesis->num_uses ? "what of it helps there" : "it",
                   outlook_of(uses, count), 100 * cause->shrink, 100 * cause->shrink_low,
                   100 * cause->shrink_high);
}

void text_summary(const diagnosis_t* diagnosis, const char* output_unit, char* text, size_t size)
{
    char gap[200];
    (void)snprintf(
        gap, sizeof gap, "The model's error on this record is %.4g%s%s RMS, %.3g %% of the output's range",
        diagnosis->rmse, output_unit[0] != '\0' ? " " : "", output_unit, 100 * diagnosis->relative);
    const cause_t* cause = &diagnosis->cause[0];
    if (diagnosis->is_unknown) {
        const char* looks = looks_of(diagnosis);
        (void)snprintf(text, size, "%s. It has structure that no effect of the catalogue explains%s%s.", gap,
                       looks[0] != '\0' ? "; it looks like " : "", looks);
    } else if (cause->hypothesis->num_uses == 0) {
        (void)snprintf(text, size, "%s. %s", gap,
                       diagnosis->confident || diagnosis->num_indistinguishable == 0
                           ? "It is no more than the noise and the misfit that the model is known to have."
                           : "No effect is likely enough beside none to be named (not confident).");
    } else {
        char names[400];
        char outlook[300];
        text_names(cause->hypothesis, names, sizeof names);
        describe_outlook(cause, outlook, sizeof outlook);
        (void)snprintf(text, size, "%s, and the likeliest cause is %s (probability %.0f %%%s). %s", gap,
                       names, 100 * cause->probability, diagnosis->confident ? "" : ", not confident",
                       outlook);
    }
}
