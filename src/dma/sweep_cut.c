/* Excludes isotherms, temperature sweeps and points by temperature, frequency or time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/sweep_input.h"

#include "core/data/sweep_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A single value excludes the data within 0.5 K (stability of a chamber) or within 1 % of a
 * frequency. */
static const double same_temperature = 0.5, same_frequency = 0.01;

typedef struct exclusion_range {
    bool by_frequency; /* frequency, or time, which isotherms store as its inverse */
    bool by_time;
    double low, high; /* limits [K] or [rad/s] */
} exclusion_range;

/* ---- option values --------------------------------------------------------------------------- */

static wt_status fail_exclusion_text(const char *text, wt_error *err)
{
    wt_fail(err, WT_E_ARG, "\"%s\" does not say what to leave out", text);
    wt_error_expected(err,
                      "temperature:-40degC..-20degC, temperature:..-20degC, temperature:25degC, "
                      "or frequency: and hertz, or time: and seconds, in the same way");
    return WT_E_ARG;
}

static wt_status parse_limit(const exclusion_range *c, const char *text, double *value,
                             wt_error *err)
{
    const wt_quantity quantity = c->by_time        ? WT_Q_TIME
                                 : c->by_frequency ? WT_Q_FREQUENCY
                                                   : WT_Q_TEMPERATURE;
    const wt_status status = wt_quantity_parse(text, quantity, value, err);
    if (status == WT_OK && c->by_time)
        *value = 1 / *value;
    else if (status == WT_OK && c->by_frequency)
        *value *= 2 * M_PI;
    return status;
}

static wt_status parse_range(const char *text, exclusion_range *c, wt_error *err)
{
    const char *dots = strstr(text, "..");
    if (dots == NULL) {
        double at;
        const wt_status status = parse_limit(c, text, &at, err);
        c->low = c->by_frequency ? at / (1 + same_frequency) : at - same_temperature;
        c->high = c->by_frequency ? at * (1 + same_frequency) : at + same_temperature;
        return status;
    }
    char *low = wt_strndup(text, (size_t)(dots - text));
    wt_status status = WT_OK;
    double *const from = c->by_time ? &c->high : &c->low, *const to =
                                                              c->by_time ? &c->low : &c->high;
    c->low = -HUGE_VAL;
    c->high = HUGE_VAL;
    if (low[0] != '\0')
        status = parse_limit(c, low, from, err);
    if (status == WT_OK && dots[2] != '\0')
        status = parse_limit(c, dots + 2, to, err);
    free(low);
    return status == WT_OK && !(c->low < c->high) ? fail_exclusion_text(text, err) : status;
}

static wt_status parse_exclusion(const char *text, exclusion_range *c, wt_error *err)
{
    static const char temperature[] = "temperature:", frequency[] = "frequency:", time[] = "time:";
    *c = (exclusion_range){.by_time = strncmp(text, time, strlen(time)) == 0};
    c->by_frequency = c->by_time || strncmp(text, frequency, strlen(frequency)) == 0;
    const char *range = strchr(text, ':');
    if ((!c->by_frequency && strncmp(text, temperature, strlen(temperature)) != 0) ||
        strcmp(range, ":") == 0 || strcmp(range, ":..") == 0)
        return fail_exclusion_text(text, err);
    return parse_range(range + 1, c, err);
}

/* ---- exclusion ------------------------------------------------------------------------------- */

static bool is_excluded(const exclusion_range *c, double x)
{
    return x >= c->low && x <= c->high;
}

/* Moves the remaining points to the front and returns their number. */
static size_t compact_points(const exclusion_range *c, sweep_points p)
{
    size_t n_left = 0;
    for (size_t i = 0; i < p.n; i++) {
        if (is_excluded(c, p.array[SWEEP_VARIABLE][i]))
            continue;
        for (size_t k = 0; k < SWEEP_ARRAYS; k++)
            if (p.array[k] != NULL)
                p.array[k][n_left] = p.array[k][i];
        n_left++;
    }
    return n_left;
}

/* Excluded sweeps and the number of excluded single points. */
typedef struct removed_data {
    wt_sweep sweep;
    size_t points;
} removed_data;

static void exclude_isotherms(const exclusion_range *c, wt_sweep *sweep, removed_data *g)
{
    size_t n_left = 0;
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        wt_isotherm *t = &sweep->isotherms[i];
        const size_t before = t->n;
        if (c->by_frequency)
            t->n = compact_points(c, isotherm_points(t));
        if (t->n == 0 || (!c->by_frequency && is_excluded(c, t->temperature))) {
            g->sweep.isotherms[g->sweep.n_isotherms++] = *t;
        } else {
            g->points += before - t->n;
            sweep->isotherms[n_left++] = *t;
        }
    }
    sweep->n_isotherms = n_left;
}

static void exclude_ramps(const exclusion_range *c, wt_sweep *sweep, removed_data *g)
{
    size_t n_left = 0;
    for (size_t i = 0; i < sweep->n_ramps; i++) {
        wt_ramp *t = &sweep->ramps[i];
        const size_t before = t->n;
        if (!c->by_frequency)
            t->n = compact_points(c, ramp_points(t));
        if (t->n == 0 || (c->by_frequency && is_excluded(c, t->angular_frequency))) {
            g->sweep.ramps[g->sweep.n_ramps++] = *t;
        } else {
            g->points += before - t->n;
            sweep->ramps[n_left++] = *t;
        }
    }
    sweep->n_ramps = n_left;
}

static wt_status apply_exclusion(const char *text, wt_sweep *sweep, wt_log *log, wt_error *err)
{
    exclusion_range c;
    wt_status status = parse_exclusion(text, &c, err);
    if (status == WT_OK && c.by_frequency && c.by_time != (sweep->loading != WT_OSCILLATION)) {
        status = wt_fail(err, WT_E_ARG, "\"%s\" is of no point of this DMA", text);
        wt_error_expected(err, c.by_time ? "frequency: for an oscillation"
                                         : "time: for relaxation and creep");
    }
    removed_data g = {.sweep = {.isotherms = wt_alloc(sweep->n_isotherms, sizeof *sweep->isotherms),
                                .ramps = wt_alloc(sweep->n_ramps, sizeof *sweep->ramps)}};
    if (status == WT_OK) {
        exclude_isotherms(&c, sweep, &g);
        exclude_ramps(&c, sweep, &g);
        const size_t isotherms = g.sweep.n_isotherms, ramps = g.sweep.n_ramps;
        const bool none = isotherms + ramps + g.points == 0;
        wt_log_add(log, none ? WT_WARNING : WT_NOTE, NULL, NULL,
                   "left out by %s: %zu isotherms, %zu temperature sweeps, %zu points of "
                   "others%s",
                   text, isotherms, ramps, g.points, none ? "; nothing lies there" : "");
    }
    wt_sweep_clear(&g.sweep);
    return status;
}

wt_status flow_exclusions_check(const char *const *texts, size_t n, wt_error *err)
{
    wt_status status = WT_OK;
    exclusion_range c;
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = parse_exclusion(texts[i], &c, err);
    return status;
}

wt_status flow_sweep_exclude(const char *const *texts, size_t n, wt_sweep *sweep, wt_log *log,
                             wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = apply_exclusion(texts[i], sweep, log, err);
    if (status == WT_OK && n > 0 && sweep->n_isotherms + sweep->n_ramps == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no isotherm is left");
        wt_error_place(err, "exclude");
        wt_error_advice(err, "leave out less");
    }
    return status;
}
