#include "diagnose_verdict.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Grain in parts of floor and gap.
static const double known_floor_grain = 0.14;
static const double gap_grain = 5e-4;
/// Where an explanation leaves less than the floor expected, the body cannot be much worse than that.
static const double floor_over_least = 1.5;
/// Weight of a hypothesis is the ratio of what is left to this power, times this for each effect: there are
/// more hypotheses the more effects they have.
static const double sharpness = 8;
static const double prior = 0.5;

scale_t scale_new(double noise, double misfit, double doubt, double gap)
{
    const double known = fmax(misfit, noise);
    scale_t scale = {.noise = noise, .known = known};
    // A body misfits more on other work than on its calibration (THEORY section 6).
    scale.floor = known + (known - noise) + doubt;
    scale.floor_grain = known_floor_grain;
    scale.grain = scale.floor_grain * scale.floor + gap_grain * gap;
    return scale;
}

/// The mean of what normal errors of standard deviation 1 have beyond h, cubed.
static double cube_beyond(double h)
{
    const double density = exp(-0.5 * h * h) / sqrt(2 * acos(-1));
    const double above = 0.5 * erfc(h / sqrt(2));
    return (2 + h * h) * density - (3 * h + h * h * h) * above;
}

static double mean_square_behind_steps(double mean_square, double step)
{
    const double s = sqrt(mean_square);
    return s > 0 ? 2 * s * s * s / (3 * step) * (cube_beyond(0) - cube_beyond(step / s)) : 0;
}

/// A body misfits up to so many times more on other work than on its bench (THEORY section 6). What is left
/// behind a step goes with the cube of that: it is known to half of itself.
static const double misfit_grows = 2;
static const double known_behind_steps = 0.5;

scale_t scale_behind_steps(const scale_t* scale, double step, double gap, size_t samples)
{
    const double wide = misfit_grows * misfit_grows;
    scale_t behind = {.noise = mean_square_behind_steps(scale->noise, step),
                      .known = mean_square_behind_steps(wide * scale->known, step),
                      .floor = mean_square_behind_steps(wide * scale->floor, step)};
    // The squares' own variance over that of their mean: E d^4 = 1.28 s^5 / step.
    const double of_samples = scale->floor > 0 ? 4.5 * step / (sqrt(scale->floor) * (double)samples) : 0;
    behind.floor_grain = sqrt(known_behind_steps * known_behind_steps + of_samples);
    behind.grain = behind.floor_grain * behind.floor + gap_grain * gap;
    return behind;
}

void scale_lower(scale_t* scale, double least)
{
    const double floor = fmin(scale->floor, fmax(scale->known, floor_over_least * least));
    scale->grain += scale->floor_grain * (floor - scale->floor);
    scale->floor = floor;
}

double scale_least_floor(const scale_t* scale)
{
    return fmin(scale->floor, floor_over_least * scale->known);
}

static double above_floor(const scale_t* scale, const hypothesis_t* hypothesis)
{
    return fmax(hypothesis_mean_square(hypothesis) - scale->floor, 0);
}

double verdict_score(const scale_t* scale, const hypothesis_t* hypothesis)
{
    // Far above the floor what is above it, far below it less and less.
    const double above = hypothesis_mean_square(hypothesis) - scale->floor;
    return log(0.5 * (above + sqrt(above * above + 4 * scale->grain * scale->grain))) +
           hypothesis_price(hypothesis);
}

size_t verdict_best(const scale_t* scale, const candidates_t* c)
{
    size_t best = 0;
    for (size_t i = 1; i < c->count; i++) {
        best =
            verdict_score(scale, &c->hypothesis[i]) < verdict_score(scale, &c->hypothesis[best]) ? i : best;
    }
    return best;
}

/// Whether another hypothesis of the same names stands better, or as well and comes first.
static bool is_shadowed(const scale_t* scale, const candidates_t* c, size_t i)
{
    const double own = verdict_score(scale, &c->hypothesis[i]);
    for (size_t k = 0; k < c->count; k++) {
        const double other = verdict_score(scale, &c->hypothesis[k]);
        if (k != i && hypothesis_same_names(&c->hypothesis[i], &c->hypothesis[k]) &&
            (other < own || (k < i && other <= own))) {
            return true;
        }
    }
    return false;
}

static int by_probability(const void* a, const void* b)
{
    const double x = ((const cause_t*)a)->probability;
    const double y = ((const cause_t*)b)->probability;
    return (x < y) - (x > y);
}

/// From this probability on a verdict is confident: beside one that contains it at the price of half an
/// effect, the right one has 0.89 at most.
static const double confident_from = 0.87;
/// What is at least this part as likely as the verdict cannot be told from it.
static const double in_set_from = 0.25;
/// Nothing is named that is not this many times as likely as no effect: a false alarm sends somebody after a
/// fault that is not there, what is passed over stands beside the verdict.
static const double alarm_from = 6;
/// Of the energy above the floor, what the best explanation may leave without being unknown: on open cases
/// right ones left up to 0.05, those of effects outside the catalogue 0.19 and more.
static const double left_at_most = 0.15;
/// In parts of the floor, what may stand above it before anything is unknown: floors are known no better.
static const double known_to = 1.5;

/// Whether it is the model with no more than the converter that the record's own values show.
static bool names_nothing(const cause_t* cause)
{
    bool nothing = true;
    for (size_t i = 0; i < cause->hypothesis->num_uses; i++) {
        nothing = nothing && cause->hypothesis->use[i].effect->rounds;
    }
    return nothing;
}

/// Of the gap's mean square what a converter's steps alone explain: hypotheses are weighed on what is left
/// beyond half a step, where that is gone already.
static double mean_square_of_steps(const cause_t* cause)
{
    double sum = 0;
    if (!names_nothing(cause)) {
        return sum;
    }
    for (size_t i = 0; i < cause->hypothesis->num_uses; i++) {
        const double step = cause->hypothesis->use[i].parameter[0];
        sum += step * step / 12;
    }
    return sum;
}

/// Keeps the likeliest, and the one that names nothing.
static void keep_most(diagnosis_t* d)
{
    for (size_t k = DIAGNOSIS_MOST_CAUSES; k < d->num_causes; k++) {
        if (names_nothing(&d->cause[k])) {
            d->cause[DIAGNOSIS_MOST_CAUSES - 1] = d->cause[k];
        }
    }
    d->num_causes = d->num_causes < DIAGNOSIS_MOST_CAUSES ? d->num_causes : DIAGNOSIS_MOST_CAUSES;
}

/// One cause for each set of names, the better mechanism's.
static void weigh(const scale_t* scale, const candidates_t* c, diagnosis_t* d)
{
    const double best = verdict_score(scale, &c->hypothesis[verdict_best(scale, c)]);
    d->cause = xcalloc(c->count, sizeof *d->cause);
    double total = 0;
    for (size_t i = 0; i < c->count; i++) {
        const hypothesis_t* h = &c->hypothesis[i];
        if (h->is_another || is_shadowed(scale, c, i)) {
            continue;
        }
        cause_t* cause = &d->cause[d->num_causes++];
        const double weight = exp(-sharpness * (verdict_score(scale, h) - best));
        *cause = (cause_t){.hypothesis = h, .probability = weight * pow(prior, (double)h->num_uses)};
        total += cause->probability;
    }
    for (size_t k = 0; k < d->num_causes; k++) {
        d->cause[k].probability /= total;
    }
    qsort(d->cause, d->num_causes, sizeof *d->cause, by_probability);
    keep_most(d);
}

/// Puts the model alone first where no cause is enough likelier.
static void mind_alarms(diagnosis_t* d)
{
    for (size_t k = 1; k < d->num_causes; k++) {
        const cause_t cause = d->cause[k];
        if (names_nothing(&cause) && alarm_from * cause.probability > d->cause[0].probability) {
            memmove(&d->cause[1], &d->cause[0], k * sizeof *d->cause);
            d->cause[0] = cause;
        }
    }
}

void verdict_find(const scale_t* scale, const candidates_t* c, diagnosis_t* d)
{
    weigh(scale, c, d);
    const double likeliest = d->cause[0].probability;
    const hypothesis_t* leader = d->cause[0].hypothesis;
    const double above = above_floor(scale, &c->hypothesis[0]) + mean_square_of_steps(&d->cause[0]);
    const double left = above > 0 ? above_floor(scale, leader) / above : 0;
    const bool is_outside = hypothesis_outside(leader) != NULL;
    d->is_unknown =
        is_outside || (above_floor(scale, leader) > known_to * scale->floor && left > left_at_most);
    if (!d->is_unknown) {
        mind_alarms(d);
    }
    d->is_none = d->cause[0].hypothesis->num_uses == 0 && !d->is_unknown;
    for (size_t k = 1; k < d->num_causes && d->num_indistinguishable < 8; k++) {
        if (d->cause[k].probability > in_set_from * likeliest && !d->is_unknown) {
            d->indistinguishable[d->num_indistinguishable++] = k;
        }
    }
    d->confident = d->is_unknown && !is_outside
                       ? left > 0.6 && above_floor(scale, leader) > 2 * scale->floor
                       : d->cause[0].probability >= confident_from && !(left > 0.1 && left < 0.3);
}
