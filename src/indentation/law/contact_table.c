/* Table of a contact function for fast evaluation: piecewise quintic polynomials.
 *
 * The knots lie in the depth e = delta - b^2/R beyond the switch, 64 to every power of two. The
 * bits of e then give the number of the piece, and the jump of the curvature at the switch is a
 * knot. Value, slope and curvature are exact at the knots. The interpolation error is below 1e-13
 * of G. Below the switch a formula applies, and just beyond it, within the smallest depth, the
 * direct function. Tips without a switch have formulas too, except the sphere.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/math/simd.h"
#include "indentation/law/tip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MANTISSA_BITS = 6,                  /* 64 pieces per octave */
    SHIFT = 52 - MANTISSA_BITS,         /* of an IEEE double */
    MAX_PIECES = 2048 << MANTISSA_BITS, /* all exponents of a double */
};

/* One cache line, loaded as two vectors of four numbers. */
typedef struct piece {
    double c[6]; /* in t = 0..1 over the piece */
    double start, inverse_width;
} piece;
enum { PIECE = sizeof(piece) / sizeof(double) };

struct wt_contact_table {
    wt_tip tip;
    double switch_depth;
    uint64_t first; /* bits >> SHIFT of the start of the first piece */
    size_t n;
    piece pieces[];
};

static uint64_t piece_number(double e)
{
    uint64_t bits;
    memcpy(&bits, &e, sizeof bits);
    return bits >> SHIFT;
}

static double piece_start(uint64_t number)
{
    uint64_t bits = number << SHIFT;
    double e;
    memcpy(&e, &bits, sizeof e);
    return e;
}

/* Rise of G over a piece by integration of the slope. Near the switch a piece is very narrow, and a
 * difference of two rounded values would cost the slope five digits. Three Gauss points are exact
 * to 1e-16 on such a piece. */
static double piece_rise(const wt_tip *tip, double from, double w)
{
    double half = sqrt(0.15) * w, middle = from + 0.5 * w;
    return w / 18.0 *
           (5.0 * (contact_values(tip, middle - half).slope +
                   contact_values(tip, middle + half).slope) +
            8.0 * contact_values(tip, middle).slope);
}

/* Creates a piece. `lo` has the values at its start on entry and at its end on return. */
static piece create_piece(const wt_tip *tip, double switch_depth, uint64_t number,
                          contact_point_values *lo)
{
    const double e = piece_start(number), end = piece_start(number + 1), w = end - e;
    const contact_point_values hi = contact_values(tip, switch_depth + end);
    const double g = lo->g, d = lo->slope * w, s = 0.5 * lo->curvature * w * w;
    /* Remainder at the far end after the first three terms; it determines the last three terms. */
    const double rf = piece_rise(tip, switch_depth + e, w) - d - s, rd = hi.slope * w - d - 2.0 * s,
                 rs = hi.curvature * w * w - 2.0 * s;
    *lo = hi;
    return (piece){{g, d, s, 10.0 * rf - 4.0 * rd + 0.5 * rs, -15.0 * rf + 7.0 * rd - rs,
                    6.0 * rf - 3.0 * rd + 0.5 * rs},
                   e,
                   1.0 / w};
}

wt_status wt_contact_table_new(const wt_tip *tip, double delta_min, double delta_max,
                               wt_contact_table **table, wt_error *err)
{
    wt_status status = wt_tip_check(tip, err);
    if (status != WT_OK)
        return status;
    if (!(delta_min > 0.0) || !(delta_max > delta_min) || !isfinite(delta_max)) {
        status =
            wt_fail(err, WT_E_RANGE, "range of indentations for a contact table is not usable");
        wt_error_expected(err, "0 < smallest < largest indentation");
        wt_error_found(err, "%g m to %g m", delta_min, delta_max);
        return status;
    }
    double at = contact_switch_depth(tip);
    uint64_t first = 0;
    size_t n = 0;
    if ((at > 0.0 || tip->shape == WT_TIP_SPHERE) && delta_max - at > delta_min) {
        first = piece_number(delta_min);
        n = (size_t)(piece_number(delta_max - at) - first) + 1;
    }
    if (n > MAX_PIECES)
        return wt_fail(err, WT_E_INTERNAL, "contact table of %zu pieces", n);
    wt_contact_table *t = wt_alloc(1, sizeof *t + n * sizeof t->pieces[0]);
    t->tip = *tip;
    t->switch_depth = at;
    t->first = first;
    t->n = n;
    contact_point_values lo = contact_values(tip, at + piece_start(first));
    for (size_t i = 0; i < n; i++)
        t->pieces[i] = create_piece(tip, at, first + i, &lo);
    *table = t;
    return WT_OK;
}

const wt_tip *contact_table_tip(const wt_contact_table *table)
{
    return &table->tip;
}

void wt_contact_table_free(wt_contact_table *table)
{
    free(table);
}

static inline contact_point_values evaluate_scalar(const wt_contact_table *table, double d)
{
    const double at = table->switch_depth;
    uint64_t number;
    if (!(d > 0.0)) { /* out of contact */
        const double none = isnan(d) ? d : 0.0;
        return (contact_point_values){none, none, none};
    }
    if (d <= at) {
        const double a = sqrt(table->tip.radius * d);
        return (contact_point_values){4.0 / 3.0 * a * d, 2.0 * a, a / d};
    }
    if ((number = piece_number(d - at) - table->first) >= table->n)
        return contact_values(&table->tip, d);
    const piece *p = &table->pieces[number];
    const double *c = p->c, t = (d - at - p->start) * p->inverse_width;
    return (contact_point_values){
        c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5])))),
        (c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])))) * p->inverse_width,
        (2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]))) * p->inverse_width *
            p->inverse_width};
}

/* Loads four numbers, from number k on, of each of four pieces and transposes them. */
WIDE_INLINE void load_columns(const wt_contact_table *table, const wide_bits *number, size_t k,
                              wide to[WIDE])
{
    const double *from = (const double *)table->pieces + k;
    wide a, b, c, d; /* separate variables; an array would be split through memory */
    simd_load(&a, from + (*number)[0] * PIECE);
    simd_load(&b, from + (*number)[1] * PIECE);
    simd_load(&c, from + (*number)[2] * PIECE);
    simd_load(&d, from + (*number)[3] * PIECE);
    const wide even = __builtin_shufflevector(a, b, 0, 4, 2, 6),
               odd = __builtin_shufflevector(a, b, 1, 5, 3, 7),
               even2 = __builtin_shufflevector(c, d, 0, 4, 2, 6),
               odd2 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    to[0] = __builtin_shufflevector(even, even2, 0, 1, 4, 5);
    to[1] = __builtin_shufflevector(odd, odd2, 0, 1, 4, 5);
    to[2] = __builtin_shufflevector(even, even2, 2, 3, 6, 7);
    to[3] = __builtin_shufflevector(odd, odd2, 2, 3, 6, 7);
}

/* Output arrays [n]; slope and curvature may be NULL. */
typedef struct value_arrays {
    double *g, *slope, *curvature;
} value_arrays;

/* Evaluates four depths from i on. Returns false unless pieces cover all of them. */
WIDE_INLINE bool evaluate_lanes(const wt_contact_table *table, const double *delta, size_t i,
                                value_arrays to)
{
    wide d, c[2 * WIDE]; /* members of a piece */
    simd_load(&d, delta + i);
    d -= table->switch_depth;
    const wide_bits number = ((wide_bits)d >> SHIFT) - (int64_t)table->first;
    const wide_bits out = (d <= 0.0) | (number < 0) | (number >= (int64_t)table->n);
    if ((out[0] | out[1] | out[2] | out[3]) != 0)
        return false;
    load_columns(table, &number, 0, c);
    load_columns(table, &number, WIDE, c + WIDE);
    const wide t = (d - c[6]) * c[7];
    const wide value = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
    simd_store(to.g + i, &value);
    if (to.slope != NULL) {
        const wide rise =
            (c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])))) * c[7];
        simd_store(to.slope + i, &rise);
    }
    if (to.curvature != NULL) {
        const wide bend =
            (2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]))) * c[7] * c[7];
        simd_store(to.curvature + i, &bend);
    }
    return true;
}

WIDE_REGISTERS static void evaluate_depths(const wt_contact_table *table, const double *delta,
                                           size_t n, value_arrays to)
{
    for (size_t i = 0; i < n; i += WIDE) {
        const size_t end = i + WIDE < n ? i + WIDE : n;
        if (i + WIDE <= n && evaluate_lanes(table, delta, i, to))
            continue;
        for (size_t j = i; j < end; j++) {
            const contact_point_values v = evaluate_scalar(table, delta[j]);
            to.g[j] = v.g;
            if (to.slope != NULL)
                to.slope[j] = v.slope;
            if (to.curvature != NULL)
                to.curvature[j] = v.curvature;
        }
    }
}

void contact_table_values(const wt_contact_table *table, const double *delta, size_t n, double *g,
                          double *slope, double *curvature)
{
    evaluate_depths(table, delta, n, (value_arrays){g, slope, curvature});
}

void wt_contact_table_eval(const wt_contact_table *table, const double *delta, size_t n, double *g,
                           double *slope)
{
    if (!(table->tip.sample_thickness.value > 0.0)) {
        evaluate_depths(table, delta, n, (value_arrays){g, slope, NULL});
        return;
    }
    for (size_t i = 0; i < n; i++) {
        contact_point_values v = evaluate_scalar(table, delta[i]);
        if (delta[i] > 0.0)
            v = thin_sample_values(&table->tip, v);
        g[i] = v.g;
        if (slope != NULL)
            slope[i] = v.slope;
    }
}
