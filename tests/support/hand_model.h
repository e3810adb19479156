/// A model by hand, in the form of a generated header: every golden value is exact in binary and follows from
/// Eqs. (6) and (8) with pencil and paper.
#ifndef HYST_TESTS_HAND_MODEL_H
#define HYST_TESTS_HAND_MODEL_H

#include "hyst/hyst_f32.h"

#define HAND_NAME               "hand"
#define HAND_NUM_PLAYS          2
#define HAND_RAM_BYTES          (sizeof(hyst_f32_state_t) + HAND_NUM_PLAYS * sizeof(hyst_f32_segment_t))
#define HAND_FLASH_BYTES        (sizeof(hand_model) + sizeof(hand_play) + sizeof(hand_knot))
#define HAND_GOLDEN_FLASH_BYTES (sizeof(hand_golden) + 4 * sizeof(hand_input))

/// Radii 0.25 and 1, weights 1 and 2.
static const hyst_f32_play_t hand_play[HAND_NUM_PLAYS] = {{0.5F, 0.0F, 1.0F}, {2.0F, 1.5F, 3.0F}};
static const hyst_f32_knot_t hand_knot[3] = {
    {0.0F, 0.0F, 0.5F, 0.5F, 1.25F, 0.0F, 0.0F},
    {2.0F, 1.0F, 1.5F, 3.0F, 0.5F, 0.0F, 0.5F},
    {4.0F, 4.0F, 0.0F, 4.0F, 0.0F, 1.0F, 0.0F},
};
static const hyst_f32_model_t hand_model = {
    .format = HYST_MODEL_FORMAT,
    .num_plays = HAND_NUM_PLAYS,
    .num_knots = 3,
    .input_min = 0.0F,
    .input_max = 4.0F,
    .constant = -1.0F,
    .moment = 2.25F,
    .play = hand_play,
    .knot = hand_knot,
};

/// 1, 2.5, 3.5, 3, 0.5, 3, 4, 1.5, 1.5, 2.25, 0, 3.25
static const uint32_t hand_input[12] = {0x3F800000, 0x40200000, 0x40600000, 0x40400000,
                                        0x3F000000, 0x40400000, 0x40800000, 0x3FC00000,
                                        0x3FC00000, 0x40100000, 0x00000000, 0x40500000};
/// 2.75, 3.75, 7.25, 7, 4.625, 6, 9.75, 7.625, 7.625, 7.75, 2.75, 6
static const uint32_t hand_output[12] = {0x40300000, 0x40700000, 0x40E80000, 0x40E00000,
                                         0x40940000, 0x40C00000, 0x411C0000, 0x40F40000,
                                         0x40F40000, 0x40F80000, 0x40300000, 0x40C00000};
/// 4.75, 9.75, 6.125, 2.75, 9.75, 9.75, 2.75, 9.75, 2.75, 8.75, 8.5, 4.125
static const uint32_t hand_wanted[12] = {0x40980000, 0x411C0000, 0x40C40000, 0x40300000,
                                         0x411C0000, 0x411C0000, 0x40300000, 0x411C0000,
                                         0x40300000, 0x410C0000, 0x41080000, 0x40840000};
/// 3, 4, 1.5, 0, 4, 4, 0, 4, 0, 3.5, 3.75, 0.5
static const uint32_t hand_inverse[12] = {0x40400000, 0x40800000, 0x3FC00000, 0x00000000,
                                          0x40800000, 0x40800000, 0x00000000, 0x40800000,
                                          0x00000000, 0x40600000, 0x40700000, 0x3F000000};
static const hyst_f32_golden_t hand_golden = {12, hand_input, hand_output, hand_wanted, hand_inverse};

#endif
