/* Friction with and without an effect at one list of velocities: strain softening, flash
 * temperature, transversely isotropic rubber.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/text.h"
#include "core/table/table_rows.h"
#include "dma/rubber.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "weartrack/friction.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Friction with and without an effect. */
typedef struct friction_difference {
    const wt_sliding *sliding;         /* contact with the effect; borrowed */
    double *velocity;                  /* [n] the last is the reference */
    wt_friction_point *with, *without; /* [n] */
    size_t n;
    double temperature;    /* temperature of the rubber or of its surroundings [K] */
    double *below, *above; /* [n] shares of the hysteresis from strains below and above the table
                              of a softening; NULL without one */
    double strain;         /* largest strain with a softening */
} friction_difference;

static double *list_velocities(const wt_sliding *sliding)
{
    double *const v = wt_alloc(sliding->n_velocity + 1, sizeof *v);
    memcpy(v, sliding->velocity, sliding->n_velocity * sizeof *v);
    v[sliding->n_velocity] = flow_reference_velocity(sliding);
    return v;
}

/* Computes the friction for the stated values. The caller clears the contact, also on failure. */
static wt_status compute_points(const wt_sliding *sliding, const wt_job *work,
                                const double *velocity, wt_friction_point *points,
                                sliding_contact *contact, wt_error *err)
{
    wt_status status = sliding_contact_create_stated(sliding, work, contact, err);
    if (status == WT_OK)
        status = wt_friction_compute(contact->workspace, contact->pressure, velocity,
                                     sliding->n_velocity + 1, points, err);
    return status;
}

static void add_cost(cost_summary *cost, const wt_friction_point *points, size_t n)
{
    cost->items += (double)n;
    for (size_t i = 0; i < n; i++)
        if (points[i].hysteresis.value > 0)
            cost->error_estimated =
                fmax(cost->error_estimated,
                     points[i].hysteresis.numerical_error / points[i].hysteresis.value);
}

/* Writes the change at one velocity: "at 300 mm/s hysteresis friction +1.0 %, contact area -2.0 %
 * against AGAINST". */
static void describe_change(const wt_friction_point *with, const wt_friction_point *without,
                            const char *against, char *text, size_t size)
{
    char velocity[32];
    wt_format_si(with->velocity, "m/s", 3, velocity, sizeof velocity);
    clocale_print(text, size,
                  "at %s hysteresis friction %+.1f %%, contact area %+.1f %% against %s", velocity,
                  100 * (with->hysteresis.value / without->hysteresis.value - 1),
                  100 * (with->area_ratio.value / without->area_ratio.value - 1), against);
}

/* ---- transversely isotropic rubber ----------------------------------------------------------- */

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
    double *velocity;          /* [n] the last is the reference velocity */
    wt_friction_point *points; /* [N_FACTOR_SETS * n] */
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
    wt_rubber rubber = *d->sliding->rubber;
    wt_sliding sliding = *d->sliding;
    sliding_contact c = {0};
    rubber.transverse = select_factors(&rubber.transverse, k);
    sliding.rubber = &rubber;
    const wt_status status =
        compute_points(&sliding, &d->work, d->velocity, d->points + k * d->n, &c, err);
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

/* Factors on the modulus that a set changes, of Ez, Ep and shear; equal ones as one. */
static void describe_factors(const wt_transverse *t, size_t k, char *text, size_t size)
{
    const char *const moduli[] = {[LOSS] = "E″", [STORAGE] = "E′", [BOTH] = "E′ and E″"};
    const double loss[] = {t->axial_loss, t->plane_loss, t->shear_loss},
                 storage[] = {t->axial_storage, t->plane_storage, t->shear_storage};
    static const char *const of[] = {"Ez", "Ep", "shear"};
    clocale_print(text, size, "%s of", moduli[k]);
    for (size_t i = 0; i < COUNT_OF(of); i++) {
        const double first = factor_sets[k].storage ? storage[i] : loss[i];
        clocale_append(text, size, "%s %s times %g", i > 0 ? "," : "", of[i], first);
        if (k == BOTH && storage[i] != loss[i])
            clocale_append(text, size, " and %g", loss[i]);
    }
    clocale_append(text, size, ": ");
}

static void describe_factor_change(const directions *d, size_t k, table_writer *t)
{
    char text[384];
    describe_factors(&d->sliding->rubber->transverse, k, text, sizeof text);
    const size_t used = strlen(text);
    describe_change(&d->points[k * d->n + d->n - 1], &d->points[d->n - 1], "the isotropic material",
                    text + used, sizeof text - used);
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
    d.work.drawn = NULL; /* the cache is for another material */
    d.velocity = list_velocities(sliding);
    d.points = wt_alloc(N_FACTOR_SETS * d.n, sizeof *d.points);
    status = compute_factor_sets(&d, err);
    if (status == WT_OK)
        status = tabulate_transverse_isotropy(&d, table, err);
    cost_summary cost = {.tolerance_asked = work->tolerance};
    for (size_t k = 0; k < N_FACTOR_SETS; k++)
        if (d.is_computed[k])
            add_cost(&cost, d.points + k * d.n, d.n);
    if (status == WT_OK)
        cost_report(work, cost);
    free(d.velocity);
    free(d.points);
    return status;
}

/* ---- an effect ------------------------------------------------------------------------------- */

typedef struct friction_effect {
    const char *missing; /* message for a contact without it */
    bool (*applies)(const wt_sliding *sliding);
    void (*leave_out)(wt_sliding *sliding);
    wt_status (*extend)(friction_difference *c, const sliding_contact *with,
                        wt_error *err); /* NULL: no further quantities */
    wt_status (*tabulate)(const friction_difference *c, wt_table **table, wt_error *err);
} friction_effect;

/* Computes both contacts for the stated values and the table of the effect. */
static wt_status tabulate_effect(const friction_effect *effect, const wt_sliding *sliding,
                                 const wt_job *work, wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no effect on friction to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && !effect->applies(sliding))
        status = wt_fail(err, WT_E_ARG, "%s", effect->missing);
    if (status != WT_OK)
        return status;
    friction_difference c = {
        .sliding = sliding, .velocity = list_velocities(sliding), .n = sliding->n_velocity + 1};
    sliding_contact with = {0}, other = {0};
    wt_sliding without = *sliding;
    effect->leave_out(&without);
    c.with = wt_alloc(2 * c.n, sizeof *c.with);
    c.without = c.with + c.n;
    status = compute_points(sliding, work, c.velocity, c.with, &with, err);
    c.temperature = with.temperature;
    if (status == WT_OK && effect->extend != NULL)
        status = effect->extend(&c, &with, err);
    sliding_contact_clear(&with);
    if (status == WT_OK)
        status = compute_points(&without, work, c.velocity, c.without, &other, err);
    sliding_contact_clear(&other);
    cost_summary cost = {.tolerance_asked = work->tolerance, .items = (double)c.n};
    add_cost(&cost, c.with, c.n);
    if (status == WT_OK)
        cost_report(work, cost);
    if (status == WT_OK)
        status = effect->tabulate(&c, table, err);
    free(c.velocity);
    free(c.with);
    free(c.below);
    return status;
}

/* ---- softening ------------------------------------------------------------------------------- */

/* Row of the table: both results at one velocity. */
TABLE_ROW(softening, SOFTENING, wt_friction_point with, without; double below, above;)

TABLE_KEYS(softening, SOFTENING, char source[256], effect[192]; double strain_factor;
           wt_estimate strain, share_above;)

/* Computes the share of the friction up to the first and beyond the last strain of the table. */
static wt_status compute_shares(friction_difference *c, const sliding_contact *with, wt_error *err)
{
    wt_status status = WT_OK;
    double range[2];
    c->below = wt_alloc(2 * c->n, sizeof *c->below);
    c->above = c->below + c->n;
    c->strain = wt_friction_strain(with->workspace, with->roughness->q1);
    wt_friction_strain_range(with->workspace, range);
    for (size_t i = 0; i < c->n && status == WT_OK; i++) {
        wt_friction_node nodes[2];
        status = wt_friction_profile(with->workspace, with->pressure, c->velocity[i], range, 2,
                                     nodes, err);
        const double all = c->with[i].hysteresis.value;
        const double none = (double)NAN; /* the share is undefined without friction */
        c->below[i] = all > 0 ? fmin(fmax(nodes[0].hysteresis / all, 0), 1) : none;
        c->above[i] = all > 0 ? fmin(fmax(1 - nodes[1].hysteresis / all, 0), 1) : none;
        if (all > 0 && !(range[1] < with->roughness->q1))
            c->above[i] = 0; /* the last strain is not reached */
    }
    return status;
}

static wt_status tabulate_softening(const friction_difference *c, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&softening_schema, err);
    double above = (double)NAN;
    size_t n_without = 0;
    for (size_t i = 0; i < c->n; i++) {
        above = fmax(above, c->above[i]);
        if (i + 1 == c->n)
            break;
        TABLE_ADD(softening, &t, c->with[i], c->without[i], c->below[i], c->above[i]);
        n_without += isnan(c->above[i]) ? 1 : 0;
    }
    if (n_without > 0)
        softening_set_print(&t, SOFTENING_KEY_UNKNOWN,
                            "%zu of %zu velocities have no hysteresis friction, of which there "
                            "could be a share",
                            n_without, c->n - 1);
    softening_keys keys = {.strain_factor = c->sliding->strain_factor,
                           .strain = {c->strain, (double)NAN, (double)NAN, NULL},
                           .share_above = {above, (double)NAN, (double)NAN, NULL}};
    strain_softening_describe(c->sliding->strain_softening, keys.source, sizeof keys.source);
    describe_change(&c->with[c->n - 1], &c->without[c->n - 1], "the moduli at small strain",
                    keys.effect, sizeof keys.effect);
    softening_set_keys(&t, &keys);
    return table_end(&t, table);
}

static bool softens(const wt_sliding *sliding)
{
    return sliding->strain_softening != NULL;
}

static void leave_out_softening(wt_sliding *sliding)
{
    sliding->strain_softening = NULL;
}

wt_status wt_softened_friction_compute(const wt_sliding *sliding, const wt_job *work,
                                       wt_table **table, wt_error *err)
{
    static const friction_effect effect = {"the material does not soften with strain", softens,
                                           leave_out_softening, compute_shares, tabulate_softening};
    return tabulate_effect(&effect, sliding, work, table, err);
}

/* ---- flash temperature ----------------------------------------------------------------------- */

TABLE_ROW(flash, FLASH, double velocity; wt_friction_point with, without;)

TABLE_KEYS(flash, FLASH, wt_estimate surroundings;
           double contact_size, heat_capacity, diffusivity, macroscopic;
           char effect[192], unsettled[192], law_range[192];)

static void describe_unsolved(const wt_friction_point *points, size_t n, const char *label,
                              char *text, size_t size)
{
    char slowest[32], fastest[32];
    double least = (double)INFINITY, most = 0;
    size_t unsolved = 0;
    text[0] = '\0';
    for (size_t i = 0; i < n; i++) {
        if (!points[i].has_no_solution)
            continue;
        unsolved++;
        least = fmin(least, fabs(points[i].velocity));
        most = fmax(most, fabs(points[i].velocity));
    }
    if (unsolved == 0)
        return;
    wt_format_si(least, "m/s", 3, slowest, sizeof slowest);
    wt_format_si(most, "m/s", 3, fastest, sizeof fastest);
    snprintf(text, size, "%s at %zu of %zu velocities, %s to %s", label, unsolved, n, slowest,
             fastest);
}

void flash_describe(const wt_sliding *sliding, const wt_friction_point *points, size_t n,
                    char text[256])
{
    char none[160];
    text[0] = '\0';
    if (!sliding->flash.on)
        return;
    describe_unsolved(points, n, "; none found", none, sizeof none);
    clocale_print(text, 256, "contacts of %.3g m%s", sliding->flash.contact_size, none);
}

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
        hottest = fmax(hottest, e->with[i].temperature.value);
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
    describe_unsolved(e->with, n, "no stable temperature below 300 degC was found", keys.unsettled,
                      sizeof keys.unsettled);
    describe_law_range(e, keys.law_range);
    flash_set_keys(&t, &keys);
    return table_end(&t, table);
}

static bool is_warmed(const wt_sliding *sliding)
{
    return sliding->flash.on;
}

static void leave_out_flash(wt_sliding *sliding)
{
    sliding->flash.on = false;
}

wt_status wt_flash_temperature_compute(const wt_sliding *sliding, const wt_job *work,
                                       wt_table **table, wt_error *err)
{
    static const friction_effect effect = {"no flash temperature was asked for", is_warmed,
                                           leave_out_flash, NULL, tabulate_flash};
    return tabulate_effect(&effect, sliding, work, table, err);
}
