#include "f32_model.h"
#include "hyst/hyst_f32_seal.h"
#include <string.h>
#include <unity.h>

enum { NUM_PLAYS = 3, NUM_KNOTS = 3, WORDS = HYST_F32_SEALED_WORDS(NUM_PLAYS) };

static const float radius[NUM_PLAYS] = {0.5F, 1.0F, 2.0F};
static const float weight[NUM_PLAYS] = {1.0F, 2.0F, 4.0F};
static const hyst_f32_knot_t knot[NUM_KNOTS] = {{.input = -4.0F, .ascending = -4.0F, .descending = -4.0F},
                                                {.input = 0.0F, .ascending = 1.0F, .descending = 0.0F},
                                                {.input = 4.0F, .ascending = 4.0F, .descending = 4.0F}};
static f32_model_t made;
static hyst_f32_state_t state;
static hyst_word_t snapshot[WORDS];

void setUp(void)
{
    made = f32_tabulated(radius, weight, NUM_PLAYS, knot, NUM_KNOTS, 1.0F);
    state = f32_state(&made);
    (void)hyst_f32_step(&made.model, &state, 3.0F);
    (void)hyst_f32_step(&made.model, &state, -1.0F);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_seal(&made.model, &state, snapshot, WORDS));
}

void tearDown(void)
{
    f32_free(&made);
}

/// The check value that every description of this CRC gives: 0xCBF43926 for "123456789" needs 9 bytes, so
/// here are values for whole words, from zlib's crc32 over the same bytes.
static void test_crc_of_known_words(void)
{
    uint32_t crc = HYST_CRC32_START;
    crc = hyst_crc32(crc, UINT32_C(0x34333231)); // "1234"
    TEST_ASSERT_EQUAL_HEX32(UINT32_C(0x9BE3E0A3), ~crc);
    crc = hyst_crc32(crc, UINT32_C(0x38373635)); // "5678"
    TEST_ASSERT_EQUAL_HEX32(UINT32_C(0x9AE0DAAF), ~crc);
}

/// Restored into another state, the future is the same to the last bit.
static void test_round_trip(void)
{
    f32_model_t other = f32_tabulated(radius, weight, NUM_PLAYS, knot, NUM_KNOTS, 1.0F);
    hyst_f32_state_t restored = f32_state(&other);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_unseal(&made.model, &restored, snapshot, WORDS));
    const float inputs[] = {0.5F, 2.5F, -3.0F, 4.0F};
    for (int i = 0; i < 4; ++i) {
        const float expected = hyst_f32_step(&made.model, &state, inputs[i]);
        TEST_ASSERT_EQUAL_HEX32(f32_bits(expected),
                                f32_bits(hyst_f32_step(&made.model, &restored, inputs[i])));
    }
    f32_free(&other);
}

static void test_header_says_whose_it_is(void)
{
    TEST_ASSERT_EQUAL_MEMORY("HYST", snapshot, 4);
    TEST_ASSERT_EQUAL_HEX32(0x00010001, snapshot[1].bits);
    TEST_ASSERT_EQUAL_UINT32(NUM_PLAYS, snapshot[2].bits);
    TEST_ASSERT_EQUAL_HEX32(hyst_f32_model_crc(&made.model), snapshot[3].bits);
    TEST_ASSERT_EQUAL_UINT32(WORDS - HYST_SNAPSHOT_WORDS(0), snapshot[4].bits);
}

/// Refuses, and the state is as before in every bit that can be seen: its next outputs.
static void assert_refused(hyst_status_t expected, const hyst_f32_model_t* model, size_t length)
{
    (void)hyst_f32_reset(&made.model, &state, HYST_START_POSITIVE_SATURATION, 1.0F);
    const hyst_f32_state_t before = state;
    float saved[2][HYST_F32_SNAPSHOT_LENGTH(NUM_PLAYS)];
    TEST_ASSERT_EQUAL(HYST_STATUS_OK,
                      hyst_f32_save(&made.model, &state, saved[0], sizeof saved[0] / sizeof(float)));
    TEST_ASSERT_EQUAL(expected, hyst_f32_unseal(model, &state, snapshot, length));
    TEST_ASSERT_EQUAL_MEMORY(&before, &state, sizeof state);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK,
                      hyst_f32_save(&made.model, &state, saved[1], sizeof saved[1] / sizeof(float)));
    TEST_ASSERT_EQUAL_MEMORY(saved[0], saved[1], sizeof saved[0]);
}

/// A CRC finds every single wrong bit, wherever it is; those in the first two words are no snapshot at all.
static void test_every_flipped_bit_is_found(void)
{
    for (int word = 0; word < WORDS; ++word) {
        for (uint32_t bit = 0; bit < 32; ++bit) {
            snapshot[word].bits ^= UINT32_C(1) << bit;
            assert_refused(word < 2 ? HYST_STATUS_SNAPSHOT_FORMAT : HYST_STATUS_SNAPSHOT_TORN, &made.model,
                           WORDS);
            snapshot[word].bits ^= UINT32_C(1) << bit;
        }
    }
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_unseal(&made.model, &state, snapshot, WORDS));
}

/// Power fails after each number of words of writing a newer snapshot over an older one.
static void test_torn_writes_are_found(void)
{
    hyst_word_t older[WORDS];
    memcpy(older, snapshot, sizeof older);
    (void)hyst_f32_step(&made.model, &state, 2.0F);
    hyst_word_t newer[WORDS];
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_seal(&made.model, &state, newer, WORDS));
    for (size_t written = HYST_SNAPSHOT_HEADER_WORDS + 1; written < WORDS; ++written) {
        memcpy(snapshot, newer, written * sizeof newer[0]);
        memcpy(&snapshot[written], &older[written], (WORDS - written) * sizeof older[0]);
        assert_refused(HYST_STATUS_SNAPSHOT_TORN, &made.model, WORDS);
    }
    // Into erased memory.
    for (size_t written = 2; written < WORDS; ++written) {
        memset(snapshot, 0xFF, sizeof snapshot);
        memcpy(snapshot, newer, written * sizeof newer[0]);
        assert_refused(HYST_STATUS_SNAPSHOT_TORN, &made.model, WORDS);
    }
    for (size_t length = 0; length < WORDS; ++length) {
        memcpy(snapshot, newer, sizeof snapshot);
        assert_refused(HYST_STATUS_SNAPSHOT_TORN, &made.model, length);
    }
}

static void test_erased_memory_is_no_snapshot(void)
{
    memset(snapshot, 0xFF, sizeof snapshot);
    assert_refused(HYST_STATUS_SNAPSHOT_FORMAT, &made.model, WORDS);
    memset(snapshot, 0, sizeof snapshot);
    assert_refused(HYST_STATUS_SNAPSHOT_FORMAT, &made.model, WORDS);
}

/// Every number of the model by itself makes it another one.
static void test_a_snapshot_of_another_model_is_refused(void)
{
    hyst_f32_model_t other = made.model;
    other.constant = 2.0F;
    assert_refused(HYST_STATUS_SNAPSHOT_MODEL, &other, WORDS);
    other = made.model;
    other.nonhysteretic_slope = 1.0F;
    assert_refused(HYST_STATUS_SNAPSHOT_MODEL, &other, WORDS);
    other = made.model;
    other.moment += 1.0F;
    assert_refused(HYST_STATUS_SNAPSHOT_MODEL, &other, WORDS);
    other = made.model;
    other.num_plays = NUM_PLAYS - 1;
    assert_refused(HYST_STATUS_SNAPSHOT_MODEL, &other, WORDS);
    const uint32_t crc = hyst_f32_model_crc(&made.model);
    for (int j = 0; j < NUM_PLAYS; ++j) {
        float* numbers[] = {&made.play[j].opening, &made.play[j].loading, &made.play[j].slope};
        for (int i = 0; i < 3; ++i) {
            *numbers[i] += 0.125F;
            TEST_ASSERT_TRUE(crc != hyst_f32_model_crc(&made.model));
            *numbers[i] -= 0.125F;
        }
    }
    TEST_ASSERT_EQUAL_HEX32(crc, hyst_f32_model_crc(&made.model));
}

/// Every knot's number too, but for the last knot's slopes, which no function reads.
static void test_another_table_makes_another_model(void)
{
    enum { NUMBERS = sizeof(hyst_f32_knot_t) / sizeof(float) };
    const uint32_t crc = hyst_f32_model_crc(&made.model);
    for (size_t k = 0; k < NUM_KNOTS; ++k) {
        const hyst_f32_knot_t kept = made.knot[k];
        for (size_t i = 0; i < NUMBERS; ++i) {
            const bool unused = k + 1 == NUM_KNOTS && (i == 2 || i == 4 || i == 6);
            float number[NUMBERS];
            memcpy(number, &kept, sizeof number);
            number[i] = 0.125F;
            memcpy(&made.knot[k], number, sizeof number);
            TEST_ASSERT_EQUAL(unused, crc == hyst_f32_model_crc(&made.model));
        }
        made.knot[k] = kept;
    }
}

/// Whole and of this model, but not a state it can be in: what restore refuses stays refused.
static void test_an_impossible_payload_is_refused(void)
{
    hyst_f32_state_t impossible = state;
    impossible.input = 99.0F;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_seal(&made.model, &impossible, snapshot, WORDS));
    assert_refused(HYST_STATUS_SNAPSHOT, &made.model, WORDS);
}

static void test_null_and_short(void)
{
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_seal(NULL, &state, snapshot, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_seal(&made.model, NULL, snapshot, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_seal(&made.model, &state, NULL, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_unseal(NULL, &state, snapshot, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_unseal(&made.model, NULL, snapshot, WORDS));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_unseal(&made.model, &state, NULL, WORDS));
    hyst_word_t before[WORDS];
    memcpy(before, snapshot, sizeof before);
    (void)hyst_f32_step(&made.model, &state, 2.0F);
    TEST_ASSERT_EQUAL(HYST_STATUS_MEMORY_LENGTH, hyst_f32_seal(&made.model, &state, snapshot, WORDS - 1));
    TEST_ASSERT_EQUAL_MEMORY(before, snapshot, sizeof before);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_crc_of_known_words);
    RUN_TEST(test_round_trip);
    RUN_TEST(test_header_says_whose_it_is);
    RUN_TEST(test_every_flipped_bit_is_found);
    RUN_TEST(test_torn_writes_are_found);
    RUN_TEST(test_erased_memory_is_no_snapshot);
    RUN_TEST(test_a_snapshot_of_another_model_is_refused);
    RUN_TEST(test_another_table_makes_another_model);
    RUN_TEST(test_an_impossible_payload_is_refused);
    RUN_TEST(test_null_and_short);
    return UNITY_END();
}
