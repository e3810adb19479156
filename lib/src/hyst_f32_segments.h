/// The memory as nested segments: what a sample costs does not grow with the number of plays.
///
/// LAYOUT
///   Flash, one entry a play, sorted by radius (hyst_f32_play_t):
///     opening_j = 2 r_j              how far the envelope must come back before play j moves
///     slope_j   = p_0 + ... + p_j    slope of the plays' sum over the envelope while plays 0 ... j move
///     loading_j = sum_{i<j} p_i (opening_j - opening_i)   the loading curve L at opening_j
///   and the moment Q = sum_j p_j r_j in the model. The loading curve L(x) = sum_j p_j max(0, x - opening_j) is convex
///   and piecewise linear: L(x) = loading_j + slope_j (x - opening_j) for opening_j < x <= opening_{j+1}.
///   RAM, a stack of segments, segment[0] outermost, segment[depth - 1] the front (hyst_f32_segment_t, 16 bytes).
///   Segment i holds plays (last_{i+1}, last_i], all left by one extreme `level` of the envelope:
///     w_j = level - r_j when it was left by a rising input, level + r_j by a falling one.
///   Every segment holds a play, so last_0 = N - 1 > last_1 > ... and N segments are enough.
///   Neighbours may have the same direction: an extreme whose plays were all taken is gone.
///
/// WHAT A MOVE DOES (rising; falling is the mirror image, written with sign = -1)
///   The envelope rises to a. Segment i is `taken`, all its plays move, when
///     it is ascending:  a - level_i > 0              it is descending: a - level_i > opening_{last_i}.
///   If a segment is taken, all further in are taken too, so the ones kept are found by halving. Of the innermost kept
///   segment k, when it is descending, plays j with opening_j < a - level_k move; when it is ascending, none. The
///   moved plays become the front: level a, last = the last one moved, everything further in is forgotten.
///
/// THE SUM
///   sum_i[direction] is the sum of all p_j w_j when an input moving in that direction has just taken segment i. Over
///   segment k, kept innermost, x = a - level_k:
///     ascending:  S = sum_k[rising] + slope_last x                            (x <= 0, plays 0 ... last move along)
///     descending: S = sum_k[rising] - (loading_{last_k} - L(x))
///     none kept:  S = a slope_{N-1} - Q
///   An ascending front's sum[rising] is S itself. Its sum[falling] is computed once, when a falling input first moves a
///   play: S over segment k at the envelope level - opening_last, where the front will have been taken.
///   So each sum is a function of the segments further out alone: no running sum, no drift; the same memory has the
///   same sums, however it came about.
///
/// MONOTONE, BIT FOR BIT
///   Rounding is monotone, so `taken` is nested also as computed: a descending front d over an ascending c has
///   last = the largest j with fl(c - d) > opening_j, and a > c gives fl(a - d) >= fl(c - d); the other pairs alike.
///   Where one segment's stretch ends, its S is by construction the next stretch's first value. The loading curve is
///   rounded so that it does not fall at an opening (init checks it). A stretch is evaluated from its far end, so
///   where it begins, at a reversal, S may be off by rounding; the state therefore keeps the plays' part `plays` of
///   the present output, and a rising input gives max(S, plays), a falling one min(S, plays). This never
///   feeds back into a segment.
///
/// INVERSE
///   In one cell of the table and one stretch between two openings the output is linear in the input. From the
///   present point that line is solved first. Where the answer leaves it: cells by halving, then segments (sum_i is the
///   end value), then openings, then one linear equation.
#ifndef HYST_F32_SEGMENTS_H
#define HYST_F32_SEGMENTS_H

#endif
