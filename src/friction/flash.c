/* Effect of the flash temperature: temperature, friction and contact area with and without it, and
 * the hot solution where two solutions exist.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/flash.h"
#include "friction/friction_difference.h"

#include "core/base/clocale.h"
#include "core/table/table_rows.h"

#include <math.h>

TABLE_ROW(flash, FLASH, double velocity; wt_friction_point with, without;)

TABLE_KEYS(flash, FLASH, wt_estimate surroundings;
           double contact_size, heat_capacity, diffusivity, macroscopic;
           char effect[192], branches[192], unsettled[192], law_range[192];)

/* ---- text ------------------------------------------------------------------------------------ */

/* Number of points in a subset, with their slowest and fastest velocity. */
typedef struct velocity_extent {
    size_t n;
    double slowest, fastest;
} velocity_extent;

static velocity_extent find_velocity_extent(const wt_friction_point *points, size_t n,
                                            bool (*counts)(const wt_friction_point *point))
{
    velocity_extent e = {0, (double)INFINITY, 0};
    for (size_t i = 0; i < n; i++) {
        if (!counts(&points[i]))
            continue;
        e.n++;
        e.slowest = fmin(e.slowest, fabs(points[i].velocity));
        e.fastest = fmax(e.fastest, fabs(points[i].velocity));
    }
    return e;
}

static bool has_hot_solution(const wt_friction_point *point)
{
    return !isnan(point->hot_branch.hysteresis);
}

static bool is_unsolved(const wt_friction_point *point)
{
    return point->has_no_solution;
}

static void describe_extent(velocity_extent e, size_t n, const char *label, char *text, size_t size)
{
    char slowest[32], fastest[32];
    text[0] = '\0';
    if (e.n == 0)
        return;
    wt_format_si(e.slowest, "m/s", 3, slowest, sizeof slowest);
    wt_format_si(e.fastest, "m/s", 3, fastest, sizeof fastest);
    snprintf(text, size, "%s at %zu of %zu velocities, %s to %s", label, e.n, n, slowest, fastest);
}

void flash_describe(const wt_sliding *sliding, const wt_friction_point *points, size_t n,
                    char text[256])
{
    char two[160], none[160];
    text[0] = '\0';
    if (!sliding->flash.on)
        return;
    describe_extent(find_velocity_extent(points, n, has_hot_solution), n,
                    "; a second, hot solution", two, sizeof two);
    describe_extent(find_velocity_extent(points, n, is_unsolved), n, "; none found", none,
                    sizeof none);
    clocale_print(text, 256, "contacts of %.3g m%s%s", sliding->flash.contact_size, two, none);
}

/* ---- the job --------------------------------------------------------------------------------- */

static void describe_flash_effect(const friction_difference *e, char text[192])
{
    const wt_friction_point *with = &e->with[e->n - 1], *without = &e->without[e->n - 1];
    char velocity[32];
    wt_format_si(with->velocity, "m/s", 3, velocity, sizeof velocity);
    if (with->has_no_solution)
        snprintf(text, 192, "at %s no temperature was found", velocity);
    else
        clocale_print(text, 192,
                      "at %s %.1f K warmer at the finest scale, hysteresis friction %+.1f %%, "
                      "contact area %+.1f %%",
                      velocity, with->temperature.value - e->temperature,
                      100 * (with->hysteresis.value / without->hysteresis.value - 1),
                      100 * (with->area_ratio.value / without->area_ratio.value - 1));
}

/* WLF constants are valid up to 100 K above the glass transition (Ferry, Viscoelastic Properties of
 * Polymers). A temperature above the isotherms is outside the range to which the law was fitted. */
static void describe_law_range(const friction_difference *e, char text[192])
{
    const double most = e->sliding->rubber->temperature_max;
    double hottest = 0;
    text[0] = '\0';
    for (size_t i = 0; i < e->n; i++)
        hottest =
            fmax(hottest, fmax(e->with[i].temperature.value, e->with[i].hot_branch.temperature));
    if (hottest > most)
        clocale_print(text, 192,
                      "up to %.1f degC, above the isotherms (to %.1f degC): the shift law is "
                      "extrapolated",
                      hottest - WT_ZERO_CELSIUS, most - WT_ZERO_CELSIUS);
}

static wt_status tabulate_flash(const friction_difference *e, wt_table **table, wt_error *err)
{
    const wt_flash *flash = &e->sliding->flash;
    const size_t n = e->n - 1;
    table_writer t = table_begin(&flash_schema, err);
    for (size_t i = 0; i < n; i++) {
        const flash_row row = {e->velocity[i], e->with[i], e->without[i]};
        flash_add_row(&t, &row);
    }
    flash_keys keys = {.surroundings = {e->temperature, (double)NAN, (double)NAN, "K"},
                       .contact_size = flash->contact_size,
                       .heat_capacity = flash->heat_capacity,
                       .diffusivity = flash->diffusivity,
                       .macroscopic = flash->macroscopic};
    describe_flash_effect(e, keys.effect);
    describe_extent(find_velocity_extent(e->with, n, has_hot_solution), n,
                    "a contact that was hot stays hot", keys.branches, sizeof keys.branches);
    describe_extent(find_velocity_extent(e->with, n, is_unsolved), n,
                    "no temperature below 300 degC was found that makes itself", keys.unsettled,
                    sizeof keys.unsettled);
    describe_law_range(e, keys.law_range);
    flash_set_keys(&t, &keys);
    return table_end(&t, table);
}

wt_status wt_flash_temperature_compute(const wt_sliding *sliding, const wt_job *work,
                                       wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no flash temperature to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && !sliding->flash.on)
        status = wt_fail(err, WT_E_ARG, "no flash temperature was asked for");
    if (status != WT_OK)
        return status;
    friction_difference e;
    wt_sliding without = *sliding;
    without.flash.on = false;
    status = friction_difference_compute(sliding, &without, work, NULL, NULL, &e, err);
    if (status == WT_OK)
        status = tabulate_flash(&e, table, err);
    friction_difference_clear(&e);
    return status;
}
