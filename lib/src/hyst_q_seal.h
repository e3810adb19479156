#include "hyst_q_internal.h"
#include "hyst_snapshot_internal.h"
#if HYST_Q_BITS == 32
#include "hyst/hyst_q31_seal.h"
#define SCALAR              HYST_SCALAR_Q31
#define SEALED_WORDS(plays) HYST_Q31_SEALED_WORDS(plays)
#else
#include "hyst/hyst_q15_seal.h"
#define SCALAR              HYST_SCALAR_Q15
#define SEALED_WORDS(plays) HYST_Q15_SEALED_WORDS(plays)
#endif

static uint32_t crc_of_wide(const uint32_t crc, const uint64_t value)
{
    return hyst_crc32(hyst_crc32(crc, (uint32_t)value), (uint32_t)(value >> 32));
}

/// The last knot's slopes and shift are not used, so they are not part of the model.
static uint32_t crc_of_knots(uint32_t crc, const hyst_q_model_t* model)
{
    for (uint32_t k = 0; k < model->num_knots; ++k) {
        const hyst_q_knot_t* knot = &model->knot[k];
        crc = hyst_crc32(crc, (uint32_t)knot->input);
        crc = hyst_crc32(crc, knot->ascending);
        crc = hyst_crc32(crc, knot->descending);
        crc = hyst_crc32(crc, knot->nonhysteretic);
        if (k + 1 < model->num_knots) {
            crc = hyst_crc32(crc, knot->ascending_slope);
            crc = hyst_crc32(crc, knot->descending_slope);
            crc = hyst_crc32(crc, knot->nonhysteretic_slope);
            crc = hyst_crc32(crc, knot->shift);
        }
    }
    return crc;
}

uint32_t HYST_Q(model_crc)(const hyst_q_model_t* model)
{
    uint32_t crc = hyst_crc32(HYST_CRC32_START, model->format);
    crc = hyst_crc32(crc, model->num_plays);
    crc = hyst_crc32(crc, model->num_knots);
    crc = hyst_crc32(crc, (uint32_t)model->input_min);
    crc = hyst_crc32(crc, (uint32_t)model->input_max);
    crc = crc_of_wide(crc, (uint64_t)model->constant);
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        crc = hyst_crc32(crc, model->radius[j]);
    }
    for (uint32_t j = 0; j <= model->num_plays; ++j) {
        crc = hyst_crc32(crc, model->cumulative_weight[j]);
        crc = crc_of_wide(crc, model->cumulative_moment[j]);
    }
    return ~crc_of_knots(crc, model);
}

static hyst_seal_t seal_of(const hyst_q_model_t* model)
{
    const hyst_seal_t seal = {.scalar = SCALAR,
                              .num_plays = model->num_plays,
                              .model_crc = HYST_Q(model_crc)(model),
                              .payload_words = SEALED_WORDS(model->num_plays) - HYST_SNAPSHOT_WORDS(0)};
    return seal;
}

hyst_status_t HYST_Q(seal)(const hyst_q_model_t* model, const hyst_q_state_t* state, hyst_word_t* snapshot,
                           const size_t length)
{
    if (model == NULL || state == NULL || snapshot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    if (length < SEALED_WORDS((size_t)model->num_plays)) {
        return HYST_STATUS_MEMORY_LENGTH;
    }
    const hyst_seal_t seal = seal_of(model);
    hyst_word_t* payload = &snapshot[HYST_SNAPSHOT_HEADER_WORDS];
    uint32_t segment = state->num_segments - 1;
    for (uint32_t i = 0; i <= model->num_plays; ++i) {
        hyst_word_t* word = &payload[i / HYST_Q_NUMBERS_IN_WORD];
        const uint32_t place = i % HYST_Q_NUMBERS_IN_WORD * HYST_Q_BITS;
        const uint32_t number = hyst_q_saved_number(model, state, i, &segment);
        word->bits = place == 0 ? number : word->bits | number << place;
    }
    hyst_seal_close(&seal, snapshot);
    return HYST_STATUS_OK;
}

hyst_status_t HYST_Q(unseal)(const hyst_q_model_t* model, hyst_q_state_t* state, const hyst_word_t* snapshot,
                             const size_t length)
{
    if (model == NULL || state == NULL || snapshot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    const hyst_seal_t seal = seal_of(model);
    const hyst_status_t status = hyst_seal_check(&seal, snapshot, length);
    if (status != HYST_STATUS_OK) {
        return status;
    }
    const hyst_q_numbers_t saved = {NULL, &snapshot[HYST_SNAPSHOT_HEADER_WORDS]};
    return HYST_Q(restore_numbers)(model, state, &saved);
}
