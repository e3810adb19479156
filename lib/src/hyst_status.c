#include "hyst/hyst.h"

const char* hyst_status_text(const hyst_status_t status)
{
    switch (status) {
    case HYST_STATUS_OK:
        return "ok";
    case HYST_STATUS_NULL_POINTER:
        return "a required pointer is NULL";
    case HYST_STATUS_MODEL_FORMAT:
        return "the model was generated for another HYST_MODEL_FORMAT";
    case HYST_STATUS_PLAY_COUNT:
        return "the number of plays is 0 or above HYST_MAX_PLAYS";
    case HYST_STATUS_MEMORY_LENGTH:
        return "the memory given is too short for the model's plays";
    case HYST_STATUS_INPUT_RANGE:
        return "the input range is empty, not finite or too wide";
    case HYST_STATUS_RADIUS:
        return "a radius is not finite, below 0 or below the one before it";
    case HYST_STATUS_WEIGHT:
        return "a weight is not finite or below 0";
    case HYST_STATUS_NONHYSTERETIC:
        return "the non-hysteretic part is not finite, decreases or does not fit its slopes";
    case HYST_STATUS_KNOTS:
        return "the table's inputs do not strictly increase over the input range";
    case HYST_STATUS_ENVELOPE:
        return "an envelope is not finite, does not increase or does not fit its slopes";
    case HYST_STATUS_ENVELOPE_ORDER:
        return "the ascending envelope less a radius lies above the descending one plus it";
    case HYST_STATUS_OUTPUT_RANGE:
        return "the largest possible output is not finite";
    case HYST_STATUS_SNAPSHOT:
        return "the snapshot holds no state this model can be in";
    case HYST_STATUS_SELF_TEST:
        return "a golden vector came out with other bits than on the host";
    case HYST_STATUS_SNAPSHOT_FORMAT:
        return "no snapshot, or one of another layout, scalar or length";
    case HYST_STATUS_SNAPSHOT_MODEL:
        return "the snapshot was taken of another model";
    case HYST_STATUS_SNAPSHOT_TORN:
        return "the snapshot's checksum is wrong: it is torn or damaged";
    case HYST_STATUS_CYCLES:
        return "the number of homing cycles is 0 or above HYST_MAX_HOMING_CYCLES";
    case HYST_STATUS_LOADING:
        return "the loading curve or the moment does not follow from the radii and weights";
    }
    return "unknown status";
}
