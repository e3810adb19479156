/// The inverse's search over all of the range. Included by hyst_q_inverse.h alone.
#ifndef HYST_Q_FAR_H
#define HYST_Q_FAR_H

#include "hyst_q_pieces.h"
#include "hyst_q_solve.h"

/// Where a piece begins, and the plays' sum there.
typedef struct {
    uint32_t level;
    hyst_q_sum_t sum;
} kink_t;

/// What is known of the answer: its cell lies between two knots, the near one of which falls short, and not
/// the far one.
typedef struct {
    uint32_t near, far; ///< indices of knots
    uint32_t near_level, far_level;
} cells_t;

static inline bool falls_short(const search_t* search, const hyst_q_value_t output)
{
    return search->rising ? output < search->wanted : output > search->wanted;
}

static inline bool is_short(const search_t* search, const uint32_t nonhysteretic, const hyst_q_sum_t sum)
{
    return falls_short(search, hyst_q_total(search->model, nonhysteretic, sum));
}

static inline uint32_t level_at_knot(const search_t* search, const uint32_t k)
{
    const hyst_q_knot_t* knot = &search->model->knot[k];
    return search->rising ? knot->ascending : knot->descending;
}

/// The lower knot of the cell that begins at knot `near` in the direction of the search.
static inline uint32_t cell_from(const search_t* search, const uint32_t near)
{
    return search->rising ? near : near - 1;
}

/// The knot behind the present input.
static inline uint32_t knot_behind(const search_t* search)
{
    return search->rising ? search->state->cell : search->state->cell + 1;
}

/// Where the segment is taken as a whole.
static kink_t end_of_segment(const search_t* search, const uint32_t index)
{
    const hyst_q_segment_t* segment = &search->state->segment[index];
    const hyst_q_sum_t moment = search->model->cumulative_moment[segment->end];
    const uint32_t level = limit_of(search, index + 1, segment->end - 1U);
    kink_t kink = {level, hyst_q_front_sum(search->model, segment, level)};
    if (search->rising && segment->falling) {
        kink.sum -= 2 * moment;
    } else if (!search->rising && !segment->falling) {
        kink.sum += 2 * moment;
    }
    return kink;
}

/// Where play j begins to move, of a segment pushed against the direction of the search.
static kink_t start_of_play(const search_t* search, const hyst_q_segment_t* segment, const uint32_t j)
{
    const hyst_q_model_t* model = search->model;
    const uint32_t radius = model->radius[j];
    const hyst_q_sum_t before = hyst_q_front_sum(model, segment, segment->level);
    const hyst_q_sum_t moved =
        2 * (hyst_q_product(model->cumulative_weight[j], radius) - model->cumulative_moment[j]);
    const kink_t up = {segment->level + 2U * radius, before + moved};
    const kink_t down = {segment->level - 2U * radius, before - moved};
    return search->rising ? up : down;
}

/// About what D is where the envelope reaches the level, within one cell.
static uint32_t nonhysteretic_near(const search_t* search, const uint32_t cell, const uint32_t level)
{
    const hyst_q_knot_t* knot = &search->model->knot[cell];
    const uint32_t value = search->rising ? knot->ascending : knot->descending;
    const uint32_t slope = search->rising ? knot->ascending_slope : knot->descending_slope;
    const uint32_t offset =
        hyst_q_quotient((hyst_q_sum_t)(level - value) << HYST_Q_BITS, slope, hyst_q_leading_zeros(slope));
    return hyst_q_nonhysteretic(knot, offset < HYST_Q_WORD_MAX ? offset : HYST_Q_WORD_MAX);
}

static bool is_one(const cells_t* cells)
{
    return cells->near + 1 == cells->far || cells->far + 1 == cells->near;
}

/// Whether the output at the kink falls short, found by narrowing the cells until they tell: where the middle
/// knot lies on this side of the kink, D there and the plays' sum at the kink are together no more than the
/// output at the kink and no less than that at the knot; beyond it, the other way round. In one cell D at the
/// kink is estimated.
static bool is_kink_short(const search_t* search, cells_t* cells, const kink_t* kink)
{
    for (;;) {
        if (!is_beyond(search, kink->level, cells->near_level)) {
            return true;
        }
        if (!is_beyond(search, cells->far_level, kink->level)) {
            return false;
        }
        if (is_one(cells)) {
            const uint32_t cell = cell_from(search, cells->near);
            return is_short(search, nonhysteretic_near(search, cell, kink->level), kink->sum);
        }
        const uint32_t middle = (cells->near + cells->far) / 2;
        const uint32_t level = level_at_knot(search, middle);
        const bool short_of = is_short(search, search->model->knot[middle].nonhysteretic, kink->sum);
        if (is_beyond(search, level, kink->level)) {
            if (short_of) {
                return true;
            }
            cells->far = middle;
            cells->far_level = level;
        } else {
            if (!short_of) {
                return false;
            }
            cells->near = middle;
            cells->near_level = level;
        }
    }
}

/// The piece that holds the boundary or, where an estimate decided, one beside it. Narrows the cells too.
static piece_t search_pieces(const search_t* search, cells_t* cells, const piece_t* near,
                             const hyst_q_front_t* far)
{
    uint32_t low = far->num_kept;
    uint32_t high = near->num_kept;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const kink_t kink = end_of_segment(search, middle);
        if (is_kink_short(search, cells, &kink)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    if (low == 0) {
        return piece_of(search, 0, search->model->num_plays);
    }
    const hyst_q_segment_t* segment = &search->state->segment[low - 1];
    uint32_t end = low == near->num_kept ? near->end : first_play(search, low - 1);
    uint32_t last = low == far->num_kept                        ? far->end
                    : (segment->falling == 0) == search->rising ? end
                                                                : segment->end - 1U;
    while (end < last) {
        const uint32_t middle = end + (last - end) / 2;
        const kink_t kink = start_of_play(search, segment, middle);
        if (is_kink_short(search, cells, &kink)) {
            end = middle + 1;
        } else {
            last = middle;
        }
    }
    return piece_of(search, low, end);
}

/// Narrows the cells to one, of a piece that holds the boundary.
static void search_cells(const search_t* search, cells_t* cells, const piece_t* piece)
{
    while (!is_one(cells)) {
        const uint32_t middle = (cells->near + cells->far) / 2;
        const uint32_t level = level_at_knot(search, middle);
        const hyst_q_sum_t sum = sum_at(search, piece, level);
        if (is_short(search, search->model->knot[middle].nonhysteretic, sum)) {
            cells->near = middle;
        } else {
            cells->far = middle;
        }
    }
}

/// Searches all of the range for the cell that holds the boundary, and its piece. Returns the cell's near
/// knot. What lies out of reach is clamped to the last output within.
static uint32_t search_far(search_t* search, piece_t* piece)
{
    const hyst_q_model_t* model = search->model;
    const uint32_t end = search->rising ? model->num_knots - 1 : 0;
    const uint32_t level = level_at_knot(search, end);
    const hyst_q_front_t front = HYST_Q(find_front)(model, search->state, level, search->rising);
    const hyst_q_sum_t sum = front.below + hyst_q_front_part(model, front.end, level, !search->rising);
    const uint32_t nonhysteretic = model->knot[end].nonhysteretic;
    if (is_short(search, nonhysteretic, sum)) {
        search->clamped = true;
        search->wanted = hyst_q_total(model, nonhysteretic, sum);
    }
    const uint32_t near = knot_behind(search);
    cells_t cells = {near, end, level_at_knot(search, near), level};
    *piece = present_piece(search);
    *piece = search_pieces(search, &cells, piece, &front);
    search_cells(search, &cells, piece);
    return cells.near;
}

#endif
