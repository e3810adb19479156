#include "q_scalar.h"
#if HYST_Q_BITS == 32
#include "hyst/hyst_q31_seal.h"
#define SEALED_WORDS(num_plays) HYST_Q31_SEALED_WORDS(num_plays)
#define FORMAT_AND_SCALAR       0x00010002
#else
#include "hyst/hyst_q15_seal.h"
#define SEALED_WORDS(num_plays) HYST_Q15_SEALED_WORDS(num_plays)
#define FORMAT_AND_SCALAR       0x00010003
#endif
#include <string.h>
#include <unity.h>

enum { NUM_PLAYS = 3, WORDS = SEALED_WORDS(NUM_PLAYS), NUM_SAVED = NUM_PLAYS + 1 };

static q_model_t made;
static const SCALAR(model_t) * model;
static SCALAR(state_t) * state;
static hyst_word_t snapshot[WORDS];

static q_model_t film(void)
{
    model_t exact = model_new("film");
    exact.input_min = 30.0;
    exact.input_max = 90.0;
    exact.ascending = curve_tanh(0.16, -10.26);
    exact.descending = curve_tanh(0.201, -11.58);
    exact.nonhysteretic = curve_linear(0.02, 1.0);
    model_set_num_plays(&exact, NUM_PLAYS);
    for (int j = 0; j < NUM_PLAYS; ++j) {
        exact.radius[j] = 0.25 * (j + 1);
        exact.weight[j] = 1.0 + j;
    }
    const q_model_t q = q_new(&exact, BITS, 0.05);
    model_free(&exact);
    return q;
}

static value_t part_of_range(double part)
{
    return (value_t)((double)model->input_min + part * ((double)model->input_max - (double)model->input_min));
}

void setUp(void)
{
    made = film();
    model = &OWNED(&made).model;
    state = &STATE(&made);
    (void)SCALAR(step)(model, state, part_of_range(0.8));
    (void)SCALAR(step)(model, state, part_of_range(0.45));
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(seal)(model, state, snapshot, WORDS));
}

void tearDown(void)
{
    q_free(&made);
}

/// Restored into another state, the future is the same.
static void test_round_trip(void)
{
    q_model_t other = film();
    SCALAR(state_t)* restored = &STATE(&other);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(unseal)(model, restored, snapshot, WORDS));
    const double parts[] = {0.5, 0.7, 0.2, 1.0};
    for (int i = 0; i < 4; ++i) {
        const value_t input = part_of_range(parts[i]);
        TEST_ASSERT_EQUAL_INT32(SCALAR(step)(model, state, input), SCALAR(step)(model, restored, input));
    }
    q_free(&other);
}

static void test_header_and_payload(void)
{
    TEST_ASSERT_EQUAL_HEX32(HYST_SNAPSHOT_MAGIC, snapshot[0].bits);
    TEST_ASSERT_EQUAL_HEX32(FORMAT_AND_SCALAR, snapshot[1].bits);
    TEST_ASSERT_EQUAL_UINT32(NUM_PLAYS, snapshot[2].bits);
    TEST_ASSERT_EQUAL_HEX32(SCALAR(model_crc)(model), snapshot[3].bits);
    TEST_ASSERT_EQUAL_UINT32(WORDS - HYST_SNAPSHOT_WORDS(0), snapshot[4].bits);
    word_t saved[NUM_SAVED];
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(save)(model, state, saved, NUM_SAVED));
    for (int i = 0; i < NUM_SAVED; ++i) {
        const uint32_t word = snapshot[HYST_SNAPSHOT_HEADER_WORDS + i * HYST_Q_BITS / 32].bits;
        TEST_ASSERT_EQUAL_UINT32(saved[i], (word_t)(word >> (i * HYST_Q_BITS % 32)));
    }
}

/// Refuses, and the state is as before in every bit that can be seen.
static void assert_refused(hyst_status_t expected, const SCALAR(model_t) * other, size_t length)
{
    (void)SCALAR(reset)(model, state, HYST_START_POSITIVE_SATURATION, part_of_range(0.6));
    const SCALAR(state_t) before = *state;
    word_t saved[2][NUM_SAVED];
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(save)(model, state, saved[0], NUM_SAVED));
    TEST_ASSERT_EQUAL(expected, SCALAR(unseal)(other, state, snapshot, length));
    TEST_ASSERT_EQUAL_MEMORY(&before, state, sizeof before);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(save)(model, state, saved[1], NUM_SAVED));
    TEST_ASSERT_EQUAL_MEMORY(saved[0], saved[1], sizeof saved[0]);
}

/// A CRC finds every single wrong bit, wherever it is; those in the first two words are no snapshot at all.
static void test_every_flipped_bit_is_found(void)
{
    for (int word = 0; word < WORDS; ++word) {
        for (uint32_t bit = 0; bit < 32; ++bit) {
            snapshot[word].bits ^= UINT32_C(1) << bit;
            assert_refused(word < 2 ? HYST_STATUS_SNAPSHOT_FORMAT : HYST_STATUS_SNAPSHOT_TORN, model, WORDS);
            snapshot[word].bits ^= UINT32_C(1) << bit;
        }
    }
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(unseal)(model, state, snapshot, WORDS));
}

/// Power fails after each number of words of writing a newer snapshot over an older one.
static void test_torn_writes_are_found(void)
{
    hyst_word_t older[WORDS];
    memcpy(older, snapshot, sizeof older);
    (void)SCALAR(step)(model, state, part_of_range(0.75));
    hyst_word_t newer[WORDS];
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(seal)(model, state, newer, WORDS));
    for (size_t written = HYST_SNAPSHOT_HEADER_WORDS + 1; written < WORDS; ++written) {
        memcpy(snapshot, newer, written * sizeof newer[0]);
        memcpy(&snapshot[written], &older[written], (WORDS - written) * sizeof older[0]);
        assert_refused(HYST_STATUS_SNAPSHOT_TORN, model, WORDS);
    }
    for (size_t length = 0; length < WORDS; ++length) {
        memcpy(snapshot, newer, sizeof snapshot);
        assert_refused(HYST_STATUS_SNAPSHOT_TORN, model, length);
    }
}

static void test_erased_memory_is_no_snapshot(void)
{
    memset(snapshot, 0xFF, sizeof snapshot);
    assert_refused(HYST_STATUS_SNAPSHOT_FORMAT, model, WORDS);
    memset(snapshot, 0, sizeof snapshot);
    assert_refused(HYST_STATUS_SNAPSHOT_FORMAT, model, WORDS);
}

/// Every number of the model's own fields makes it another one.
static void test_a_snapshot_of_another_model_is_refused(void)
{
    SCALAR(model_t) other = *model;
    ++other.constant;
    assert_refused(HYST_STATUS_SNAPSHOT_MODEL, &other, WORDS);
    other = *model;
    ++other.input_min;
    assert_refused(HYST_STATUS_SNAPSHOT_MODEL, &other, WORDS);
    other = *model;
    --other.input_max;
    assert_refused(HYST_STATUS_SNAPSHOT_MODEL, &other, WORDS);
    other = *model;
    --other.num_plays;
    assert_refused(HYST_STATUS_SNAPSHOT_MODEL, &other, WORDS);
}

static void assert_changes_the_crc(void* number, size_t size)
{
    const uint32_t crc = SCALAR(model_crc)(model);
    uint8_t kept[8];
    memcpy(kept, number, size);
    for (size_t i = 0; i < size; ++i) {
        ((uint8_t*)number)[i] ^= 0x55;
        TEST_ASSERT_TRUE(crc != SCALAR(model_crc)(model));
        memcpy(number, kept, size);
    }
}

/// Every byte of its arrays too, but for the last knot's slopes and shift, which no function reads.
static void test_every_byte_of_the_arrays_counts(void)
{
    for (int j = 0; j < NUM_PLAYS; ++j) {
        assert_changes_the_crc(&OWNED(&made).radius[j], sizeof OWNED(&made).radius[j]);
    }
    for (int j = 0; j <= NUM_PLAYS; ++j) {
        assert_changes_the_crc(&OWNED(&made).cumulative_weight[j], sizeof OWNED(&made).cumulative_weight[j]);
        assert_changes_the_crc(&OWNED(&made).cumulative_moment[j], sizeof OWNED(&made).cumulative_moment[j]);
    }
    SCALAR(knot_t)* knot = OWNED(&made).knot;
    const uint32_t last = model->num_knots - 1;
    for (uint32_t k = 0; k <= last; ++k) {
        assert_changes_the_crc(&knot[k].input, sizeof knot[k].input);
        assert_changes_the_crc(&knot[k].ascending, sizeof knot[k].ascending);
        assert_changes_the_crc(&knot[k].descending, sizeof knot[k].descending);
        assert_changes_the_crc(&knot[k].nonhysteretic, sizeof knot[k].nonhysteretic);
    }
    for (uint32_t k = 0; k < last; ++k) {
        assert_changes_the_crc(&knot[k].ascending_slope, sizeof knot[k].ascending_slope);
        assert_changes_the_crc(&knot[k].descending_slope, sizeof knot[k].descending_slope);
        assert_changes_the_crc(&knot[k].nonhysteretic_slope, sizeof knot[k].nonhysteretic_slope);
        assert_changes_the_crc(&knot[k].shift, sizeof knot[k].shift);
    }
    const uint32_t crc = SCALAR(model_crc)(model);
    knot[last].ascending_slope = 1;
    knot[last].shift = 1;
    TEST_ASSERT_EQUAL_HEX32(crc, SCALAR(model_crc)(model));
}

/// Whole and of this model, but not a state it can be in: what restore refuses stays refused.
static void test_an_impossible_payload_is_refused(void)
{
    SCALAR(state_t) impossible = *state;
    impossible.input = (value_t)(model->input_max + 1);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(seal)(model, &impossible, snapshot, WORDS));
    assert_refused(HYST_STATUS_SNAPSHOT, model, WORDS);
}

static void test_null_and_short(void)
{
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, SCALAR(seal)(NULL, state, snapshot, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, SCALAR(seal)(model, NULL, snapshot, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, SCALAR(seal)(model, state, NULL, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, SCALAR(unseal)(NULL, state, snapshot, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, SCALAR(unseal)(model, NULL, snapshot, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, SCALAR(unseal)(model, state, NULL, WORDS));
    hyst_word_t before[WORDS];
    memcpy(before, snapshot, sizeof before);
    (void)SCALAR(step)(model, state, part_of_range(0.75));
    TEST_ASSERT_EQUAL(HYST_STATUS_MEMORY_LENGTH, SCALAR(seal)(model, state, snapshot, WORDS - 1));
    TEST_ASSERT_EQUAL_MEMORY(before, snapshot, sizeof before);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_round_trip);
    RUN_TEST(test_header_and_payload);
    RUN_TEST(test_every_flipped_bit_is_found);
    RUN_TEST(test_torn_writes_are_found);
    RUN_TEST(test_erased_memory_is_no_snapshot);
    RUN_TEST(test_a_snapshot_of_another_model_is_refused);
    RUN_TEST(test_every_byte_of_the_arrays_counts);
    RUN_TEST(test_an_impossible_payload_is_refused);
    RUN_TEST(test_null_and_short);
    return UNITY_END();
}
