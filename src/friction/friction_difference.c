/* Friction with and without an effect at one list of velocities: strain softening, flash
 * temperature, anisotropy of the roughness, transversely isotropic rubber.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/clocale.h"
#include "core/table/table_rows.h"
#include "dma/strain_softening.h"
#include "friction/numerics/angular.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "weartrack/friction.h"
#include "weartrack/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NONE, LOSS, STORAGE, BOTH, N_FACTOR_SETS };

static const struct {
    const char *words;
    bool storage, loss;
    transverse_isotropy_key key;
} factor_sets[N_FACTOR_SETS] = {
    [NONE] = {"none", false, false, TRANSVERSE_ISOTROPY_KEY_LEFT_OUT},
    [LOSS] = {"loss", false, true, TRANSVERSE_ISOTROPY_KEY_LOSS},
    [STORAGE] = {"storage", true, false, TRANSVERSE_ISOTROPY_KEY_STORAGE},
    [BOTH] = {"both", true, true, TRANSVERSE_ISOTROPY_KEY_BOTH}};

typedef struct directions {
    const wt_sliding *sliding;
    wt_job work;
    wt_friction_point
        *points; /* [N_FACTOR_SETS * n] the last of each n is the reference velocity */
    size_t n;
    bool is_computed[N_FACTOR_SETS];
    char left_out[256];
} directions;

static wt_transverse select_factors(const wt_transverse *given, size_t k)
{
    wt_transverse t = *given;
    if (!factor_sets[k].storage)
        t.axial_storage = t.plane_storage = t.shear_storage = 1;
    if (!factor_sets[k].loss)
        t.axial_loss = t.plane_loss = t.shear_loss = 1;
    return t;
}

static wt_status compute_factor_set(directions *d, size_t k, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_rubber rubber = *d->sliding->rubber;
    wt_sliding sliding = *d->sliding;
    wt_friction_point *points = d->points + k * d->n;
    const double reference = flow_reference_velocity(&sliding);
    sliding_contact c = {0};
    rubber.transverse = select_factors(&rubber.transverse, k);
    sliding.rubber = &rubber;
    wt_status status =
        sliding_contact_create(&sliding, &d->work, WT_NO_REPLICATE, NULL, none, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, sliding.velocity, sliding.n_velocity,
                                     points, err);
    if (status == WT_OK)
        status =
            wt_friction_compute(c.workspace, c.pressure, &reference, 1, &points[d->n - 1], err);
    sliding_contact_clear(&c);
    return status;
}

/* Computes all sets of factors. The full set must be a valid material; a partial set may be
 * invalid. */
static wt_status compute_factor_sets(directions *d, wt_error *err)
{
    for (size_t k = N_FACTOR_SETS; k-- > 0;) {
        wt_error failure = WT_ERROR_INIT;
        const wt_status status = compute_factor_set(d, k, &failure);
        d->is_computed[k] = status == WT_OK;
        if (status == WT_OK)
            continue;
        if (k == BOTH || status == WT_E_MEMORY) {
            if (err != NULL)
                *err = failure;
            return status;
        }
        const size_t used = strlen(d->left_out);
        snprintf(d->left_out + used, sizeof d->left_out - used, "%s%s: %.100s",
                 used > 0 ? "; " : "", factor_sets[k].words, failure.message);
    }
    return WT_OK;
}

TABLE_ROW(transverse_isotropy, TRANSVERSE_ISOTROPY, const char *factors; wt_friction_point point;)

static void add_points(const directions *d, size_t k, table_writer *t)
{
    table_block(t);
    for (size_t i = 0; i + 1 < d->n; i++)
        TABLE_ADD(transverse_isotropy, t, factor_sets[k].words, d->points[k * d->n + i]);
}

static void describe_factor_change(const directions *d, size_t k, table_writer *t)
{
    const wt_friction_point *p = &d->points[k * d->n + d->n - 1], *none = &d->points[d->n - 1];
    char text[192], velocity[32];
    wt_format_si(p->velocity, "m/s", 3, velocity, sizeof velocity);
    clocale_print(text, sizeof text,
                  "at %s hysteresis friction %+.1f %%, contact area %+.1f %% against the isotropic "
                  "material",
                  velocity, 100 * (p->hysteresis.value / none->hysteresis.value - 1),
                  100 * (p->area_ratio.value / none->area_ratio.value - 1));
    transverse_isotropy_set_text(t, factor_sets[k].key, text);
}

static wt_status tabulate_transverse_isotropy(const directions *d, wt_table **table, wt_error *err)
{
    char material[512];
    table_writer t = table_begin(&transverse_isotropy_schema, err);
    for (size_t k = 0; k < N_FACTOR_SETS; k++)
        if (d->is_computed[k])
            add_points(d, k, &t);
    (void)wt_rubber_describe(d->sliding->rubber, material, sizeof material);
    transverse_isotropy_set_text(&t, TRANSVERSE_ISOTROPY_KEY_MATERIAL, material);
    for (size_t k = LOSS; k < N_FACTOR_SETS; k++)
        if (d->is_computed[NONE] && d->is_computed[k])
            describe_factor_change(d, k, &t);
    if (d->left_out[0] != '\0')
        transverse_isotropy_set_text(&t, TRANSVERSE_ISOTROPY_KEY_LEFT_OUT, d->left_out);
    return table_end(&t, table);
}

static void report_directions_cost(const directions *d, const wt_job *work)
{
    cost_summary cost = {.tolerance_asked = work->tolerance};
    for (size_t k = 0; k < N_FACTOR_SETS; k++)
        for (size_t i = 0; d->is_computed[k] && i < d->n; i++) {
            const wt_estimate *h = &d->points[k * d->n + i].hysteresis;
            cost.items++;
            cost.error_estimated = fmax(cost.error_estimated, h->numerical_error / fabs(h->value));
        }
    cost_report(work, cost);
}

wt_status wt_transverse_isotropy_compute(const wt_sliding *sliding, const wt_job *work,
                                         wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no directions to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && !sliding->rubber->is_transverse)
        status = wt_fail(err, WT_E_ARG, "the material has no directions");
    if (status != WT_OK)
        return status;
    directions d = {.sliding = sliding, .work = *work, .n = sliding->n_velocity + 1};
    d.work.left_out = WT_EXTRA_ALL;
    d.work.drawn = NULL; /* the cache is for another material */
    d.points = wt_alloc(N_FACTOR_SETS * d.n, sizeof *d.points);
    status = compute_factor_sets(&d, err);
    if (status == WT_OK)
        status = tabulate_transverse_isotropy(&d, table, err);
    if (status == WT_OK)
        report_directions_cost(&d, work);
    free(d.points);
    return status;
}

typedef struct friction_difference {
    const wt_sliding *sliding;         /* variant with the effect; borrowed */
    double *velocity;                  /* [n] the last is the reference */
    wt_friction_point *with, *without; /* [n] */
    size_t n;
    double temperature; /* temperature of the rubber or of its surroundings [K] */
} friction_difference;

/* Evaluates further quantities of the contact with the effect. */
typedef wt_status friction_difference_fn(void *user, const friction_difference *c,
                                         const sliding_contact *contact, wt_error *err);

static wt_status compute_points(const friction_difference *c, const wt_sliding *sliding,
                                const wt_job *work, wt_friction_point *points,
                                sliding_contact *contact, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_job local_job = *work;
    local_job.left_out = WT_EXTRA_ALL;
    wt_status status =
        sliding_contact_create(sliding, &local_job, WT_NO_REPLICATE, NULL, none, contact, err);
    if (status == WT_OK)
        status = wt_friction_compute(contact->workspace, contact->pressure, c->velocity, c->n,
                                     points, err);
    return status;
}

static void report_difference_cost(const friction_difference *c, const wt_job *work)
{
    cost_summary cost = {.tolerance_asked = work->tolerance, .items = 2 * (double)c->n};
    for (size_t i = 0; i < c->n; i++) {
        const wt_estimate *h = &c->with[i].hysteresis;
        if (h->value > 0)
            cost.error_estimated = fmax(cost.error_estimated, h->numerical_error / h->value);
    }
    cost_report(work, cost);
}

/* Computes both variants for the stated values and reports the cost. The callback may be NULL. The
 * caller clears the result, also on failure. */
static wt_status friction_difference_compute(const wt_sliding *with, const wt_sliding *without,
                                             const wt_job *work, friction_difference_fn *extend,
                                             void *user, friction_difference *c, wt_error *err)
{
    sliding_contact contact = {0}, other = {0};
    *c = (friction_difference){.sliding = with, .n = with->n_velocity + 1};
    c->velocity = wt_alloc(c->n, sizeof *c->velocity);
    c->with = wt_alloc(c->n, sizeof *c->with);
    c->without = wt_alloc(c->n, sizeof *c->without);
    for (size_t i = 0; i < with->n_velocity; i++)
        c->velocity[i] = with->velocity[i];
    c->velocity[c->n - 1] = flow_reference_velocity(with);
    wt_status status = compute_points(c, with, work, c->with, &contact, err);
    c->temperature = contact.temperature;
    if (status == WT_OK && extend != NULL)
        status = extend(user, c, &contact, err);
    sliding_contact_clear(&contact);
    if (status == WT_OK)
        status = compute_points(c, without, work, c->without, &other, err);
    sliding_contact_clear(&other);
    if (status == WT_OK)
        report_difference_cost(c, work);
    return status;
}

static void friction_difference_clear(friction_difference *c)
{
    free(c->velocity);
    free(c->with);
    free(c->without);
    *c = (friction_difference){.n = 0};
}

/* Writes the change at one velocity: "at 300 mm/s hysteresis friction +1.0 %, contact area -2.0 %
 * against AGAINST". */
static void friction_difference_describe(const wt_friction_point *with,
                                         const wt_friction_point *without, const char *against,
                                         char *text, size_t size)
{
    char velocity[32];
    wt_format_si(with->velocity, "m/s", 3, velocity, sizeof velocity);
    clocale_print(text, size,
                  "at %s hysteresis friction %+.1f %%, contact area %+.1f %% against %s", velocity,
                  100 * (with->hysteresis.value / without->hysteresis.value - 1),
                  100 * (with->area_ratio.value / without->area_ratio.value - 1), against);
}

/* ---- the effects ------------------------------------------------------------------------------
 */

/* Row of the table: both results at one velocity. */
TABLE_ROW(softening, SOFTENING, wt_friction_point with, without; double below, above;
          /* shares of the hysteresis from strains below and above the table */)

TABLE_KEYS(softening, SOFTENING, char source[256], effect[192]; double strain_factor;
           wt_estimate strain, share_above;)

/* Results of the contact with softening. */
typedef struct effect {
    softening_row *rows; /* [n] one for each velocity; the last is the reference */
    double strain;       /* largest strain */
    double range[2];
} effect;

/* Computes the share of the friction up to the first and beyond the last strain of the table. */
static wt_status compute_shares(void *user, const friction_difference *of, const sliding_contact *c,
                                wt_error *err)
{
    effect *e = user;
    wt_status status = WT_OK;
    e->strain = wt_friction_strain(c->workspace, c->roughness->q1);
    wt_friction_strain_range(c->workspace, e->range);
    for (size_t i = 0; i < of->n && status == WT_OK; i++) {
        wt_friction_node nodes[2];
        softening_row *r = &e->rows[i];
        status = wt_friction_profile(c->workspace, c->pressure, of->velocity[i], e->range, 2, nodes,
                                     err);
        const double all = of->with[i].hysteresis.value;
        const double none = (double)NAN; /* the share is undefined without friction */
        r->below = all > 0 ? fmin(fmax(nodes[0].hysteresis / all, 0), 1) : none;
        r->above = all > 0 ? fmin(fmax(1 - nodes[1].hysteresis / all, 0), 1) : none;
        if (all > 0 && !(e->range[1] < c->roughness->q1))
            r->above = 0; /* the last strain is not reached */
    }
    return status;
}

static wt_status tabulate_softening(const friction_difference *c, const effect *e, wt_table **table,
                                    wt_error *err)
{
    table_writer t = table_begin(&softening_schema, err);
    double above = (double)NAN;
    size_t n_without = 0;
    for (size_t i = 0; i < c->n; i++) {
        e->rows[i].with = c->with[i];
        e->rows[i].without = c->without[i];
        above = fmax(above, e->rows[i].above);
        if (i + 1 == c->n)
            break;
        softening_add_row(&t, &e->rows[i]);
        n_without += isnan(e->rows[i].above) ? 1 : 0;
    }
    if (n_without > 0)
        softening_set_print(&t, SOFTENING_KEY_UNKNOWN,
                            "%zu of %zu velocities have no hysteresis friction, of which there "
                            "could be a share",
                            n_without, c->n - 1);
    softening_keys keys = {.strain_factor = c->sliding->strain_factor,
                           .strain = {e->strain, (double)NAN, (double)NAN, NULL},
                           .share_above = {above, (double)NAN, (double)NAN, NULL}};
    strain_softening_describe(c->sliding->strain_softening, keys.source, sizeof keys.source);
    friction_difference_describe(&c->with[c->n - 1], &c->without[c->n - 1],
                                 "the moduli at small strain", keys.effect, sizeof keys.effect);
    softening_set_keys(&t, &keys);
    return table_end(&t, table);
}

wt_status wt_softened_friction_compute(const wt_sliding *sliding, const wt_job *work,
                                       wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no softening to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && sliding->strain_softening == NULL)
        status = wt_fail(err, WT_E_ARG, "the material does not soften with strain");
    if (status != WT_OK)
        return status;
    friction_difference c = {.n = 0};
    wt_sliding without = *sliding;
    without.strain_softening = NULL;
    effect e = {.rows = wt_alloc(sliding->n_velocity + 1, sizeof *e.rows)};
    status = friction_difference_compute(sliding, &without, work, compute_shares, &e, &c, err);
    if (status == WT_OK)
        status = tabulate_softening(&c, &e, table, err);
    friction_difference_clear(&c);
    free(e.rows);
    return status;
}

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

/* Row of the table: both results at one velocity. */
TABLE_ROW(anisotropy, ANISOTROPY, wt_friction_point with, without;)

TABLE_KEYS(anisotropy, ANISOTROPY, char texture[192], effect[320]; wt_estimate side;)

void anisotropy_describe(const wt_anisotropy *anisotropy, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < WT_ANISOTROPY_ORDERS && used < size; k++)
        if (anisotropy->amplitude[k] != 0) {
            clocale_print(text + used, size - used, "%s%.4g cos %zu(phi - %.4g deg)",
                          used > 0 ? " + " : "", anisotropy->amplitude[k], 2 * (k + 1),
                          anisotropy->angle[k] * 180 / M_PI);
            used = strlen(text);
        }
}

static void describe_effect(const wt_friction_point *with, const wt_friction_point *without,
                            char *text, size_t size)
{
    char against[128];
    clocale_print(against, sizeof against,
                  "roughness that is the same in all directions; the force of the hysteresis turns "
                  "by %.1f deg to the side",
                  atan2(with->lateral.value, with->hysteresis.value) * 180 / M_PI);
    friction_difference_describe(with, without, against, text, size);
}

static wt_status tabulate_anisotropy(const friction_difference *c, wt_table **table, wt_error *err)
{
    const size_t n = c->n - 1;
    table_writer t = table_begin(&anisotropy_schema, err);
    for (size_t i = 0; i < n; i++)
        TABLE_ADD(anisotropy, &t, c->with[i], c->without[i]);
    anisotropy_keys keys = {.side = c->with[n].lateral};
    keys.side.standard_error = (double)NAN; /* this table draws no replicates */
    anisotropy_describe(&c->sliding->anisotropy, keys.texture, sizeof keys.texture);
    describe_effect(&c->with[n], &c->without[n], keys.effect, sizeof keys.effect);
    anisotropy_set_keys(&t, &keys);
    return table_end(&t, table);
}

wt_status wt_anisotropic_friction_compute(const wt_sliding *sliding, const wt_job *work,
                                          wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no anisotropy to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && !anisotropy_is_present(&sliding->anisotropy))
        status = wt_fail(err, WT_E_ARG, "the roughness is the same in all directions");
    if (status != WT_OK)
        return status;
    friction_difference c;
    wt_sliding without = *sliding;
    without.anisotropy = (wt_anisotropy){{0}, {0}};
    status = friction_difference_compute(sliding, &without, work, NULL, NULL, &c, err);
    if (status == WT_OK)
        status = tabulate_anisotropy(&c, table, err);
    friction_difference_clear(&c);
    return status;
}
