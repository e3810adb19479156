#include "hyst/hyst_f32_seal.h"
#include "hyst_snapshot_internal.h"

static uint32_t crc_of_real(const uint32_t crc, const float value)
{
    const hyst_word_t word = {.real = value};
    return hyst_crc32(crc, word.bits);
}

/// The last knot's slopes are not used, so they are not part of the model.
static uint32_t crc_of_knots(uint32_t crc, const hyst_f32_model_t* model)
{
    for (uint32_t k = 0; k < model->num_knots; ++k) {
        const hyst_f32_knot_t* knot = &model->knot[k];
        crc = crc_of_real(crc, knot->input);
        crc = crc_of_real(crc, knot->ascending);
        crc = crc_of_real(crc, knot->descending);
        crc = crc_of_real(crc, knot->nonhysteretic);
        if (k + 1 < model->num_knots) {
            crc = crc_of_real(crc, knot->ascending_slope);
            crc = crc_of_real(crc, knot->descending_slope);
            crc = crc_of_real(crc, knot->nonhysteretic_slope);
        }
    }
    return crc;
}

uint32_t hyst_f32_model_crc(const hyst_f32_model_t* model)
{
    uint32_t crc = hyst_crc32(HYST_CRC32_START, model->format);
    crc = hyst_crc32(crc, model->num_plays);
    crc = hyst_crc32(crc, model->num_knots);
    crc = crc_of_real(crc, model->input_min);
    crc = crc_of_real(crc, model->input_max);
    crc = crc_of_real(crc, model->constant);
    crc = crc_of_real(crc, model->nonhysteretic_slope);
    crc = crc_of_real(crc, model->moment);
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        crc = crc_of_real(crc, model->play[j].opening);
        crc = crc_of_real(crc, model->play[j].loading);
        crc = crc_of_real(crc, model->play[j].slope);
    }
    return ~crc_of_knots(crc, model);
}

static hyst_seal_t seal_of(const hyst_f32_model_t* model)
{
    const hyst_seal_t seal = {.scalar = HYST_SCALAR_F32,
                              .num_plays = model->num_plays,
                              .model_crc = hyst_f32_model_crc(model),
                              .payload_words = HYST_F32_SNAPSHOT_LENGTH(model->num_plays)};
    return seal;
}

hyst_status_t hyst_f32_seal(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                            hyst_word_t* snapshot, const size_t length)
{
    if (model == NULL || state == NULL || snapshot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    const hyst_seal_t seal = seal_of(model);
    if (length < HYST_SNAPSHOT_WORDS((size_t)seal.payload_words)) {
        return HYST_STATUS_MEMORY_LENGTH;
    }
    const hyst_status_t status =
        hyst_f32_save(model, state, &snapshot[HYST_SNAPSHOT_HEADER_WORDS].real, seal.payload_words);
    if (status == HYST_STATUS_OK) {
        hyst_seal_close(&seal, snapshot);
    }
    return status;
}

hyst_status_t hyst_f32_unseal(const hyst_f32_model_t* model, hyst_f32_state_t* state,
                              const hyst_word_t* snapshot, const size_t length)
{
    if (model == NULL || state == NULL || snapshot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    const hyst_seal_t seal = seal_of(model);
    const hyst_status_t status = hyst_seal_check(&seal, snapshot, length);
    if (status != HYST_STATUS_OK) {
        return status;
    }
    return hyst_f32_restore(model, state, &snapshot[HYST_SNAPSHOT_HEADER_WORDS].real, seal.payload_words);
}
