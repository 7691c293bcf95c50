/* Friction against velocity and temperature, and against velocity and pressure. The moduli at a
 * temperature are E(w) = E_reference(w a_T) / b_T, and friction depends on the moduli over the
 * pressure at q v alone. mu(v, T, p) therefore equals the friction at the reference temperature at
 * v a_T and p b_T, so that one workspace serves the whole map. A flash temperature needs a
 * workspace for each temperature, because it is measured from the surroundings.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/clocale.h"
#include "core/base/number.h"
#include "core/table/table_rows.h"
#include "dma/rubber.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "job/random_draws.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

TABLE_ROW(friction_map, FRICTION_MAP, const char *against;
          double temperature, pressure, velocity, reduced_velocity, shift_factor;
          double extrapolated_share; wt_estimate total, hysteresis, area_ratio;)

TABLE_KEYS(friction_map, FRICTION_MAP, wt_estimate pressure, temperature, reference_temperature,
           shear_stress;
           char material[512], statement[920], numerical[160];)

/* Velocities at one temperature and pressure. */
typedef struct map_line {
    const char *against;
    double temperature, pressure;
    rubber_shift shift;
} map_line;

typedef struct friction_map {
    const wt_sliding *sliding;
    const wt_job *work;
    size_t n_lines;
    map_line *lines;           /* [n_lines] */
    double *velocity;          /* [n_velocity] reduced velocities of one line */
    wt_friction_point *points; /* [n_velocity] */
    double lowest, highest;    /* range of all reduced velocities */
    double worst;              /* relative numerical error at points that miss the tolerance */
    size_t n_unsettled;        /* points without a solution for the flash temperature; they are
                                  NaN */
    size_t count_extrapolated; /* temperatures outside the isotherms */
    char statement[320];       /* text about them */
} friction_map;

static wt_status add_map_line(friction_map *m, const char *against, double temperature,
                              double pressure, wt_error *err)
{
    map_line *line = &m->lines[m->n_lines++];
    *line = (map_line){.against = against, .temperature = temperature, .pressure = pressure};
    const double *v = m->sliding->velocity;
    const wt_status status = flow_rubber_shift(m->sliding->rubber, temperature, &line->shift, err);
    if (status != WT_OK)
        return status;
    m->lowest = fmin(m->lowest, v[0] * line->shift.a);
    m->highest = fmax(m->highest, v[m->sliding->n_velocity - 1] * line->shift.a);
    if (line->shift.statement[0] != '\0') {
        m->count_extrapolated++;
        snprintf(m->statement, sizeof m->statement, "%s", line->shift.statement);
    }
    return WT_OK;
}

static wt_status list_map_lines(friction_map *m, wt_error *err)
{
    const wt_sliding *s = m->sliding;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < s->n_temperatures; i++)
        status = add_map_line(m, "temperature", s->temperatures[i], s->pressure.value, err);
    for (size_t i = 0; status == WT_OK && i < s->n_pressures; i++)
        status = add_map_line(m, "pressure", s->temperature.value, s->pressures[i], err);
    if (m->count_extrapolated > 1)
        clocale_print(m->statement, sizeof m->statement,
                      "at %zu of %zu temperatures and pressures the shift law is extrapolated "
                      "beyond the isotherms",
                      m->count_extrapolated, m->n_lines);
    return status;
}

/* Creates the contact at the temperature of a line. */
static wt_status create_line_contact(const friction_map *m, const map_line *line,
                                     sliding_contact *c, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_sliding sliding = *m->sliding;
    wt_job work = *m->work;
    sliding.temperature.value = line->temperature;
    work.drawn = NULL; /* the cache is for another temperature */
    return sliding_contact_create(&sliding, &work, WT_NO_REPLICATE, NULL, none, c, err);
}

/* Creates the contact at the reference temperature for the range of all reduced velocities. */
static wt_status create_reference_contact(const friction_map *m, double range[2],
                                          sliding_contact *c, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_sliding sliding = *m->sliding;
    wt_job work = *m->work;
    range[0] = m->lowest;
    range[1] = m->highest;
    sliding.temperature = (wt_estimate){(double)NAN, 0, 0, "K"};
    sliding.velocity = range;
    sliding.n_velocity = m->highest > m->lowest ? 2 : 1;
    sliding.reference_velocity = m->lowest;
    work.drawn = NULL; /* the cache is for another temperature */
    return sliding_contact_create(&sliding, &work, WT_NO_REPLICATE, NULL, none, c, err);
}

static void add_map_rows(friction_map *m, const map_line *line, table_writer *t, cost_summary *cost)
{
    const wt_sliding *s = m->sliding;
    const double reference = s->rubber->prony.reference_temperature;
    for (size_t i = 0; i < s->n_velocity; i++) {
        const wt_friction_point *p = &m->points[i];
        const double temperature = isnan(line->temperature) ? reference : line->temperature;
        const wt_estimate shear = {s->shear_stress.value, 0, 0, "Pa"};
        friction_map_row row = {
            .against = line->against,
            .temperature = temperature,
            .pressure = line->pressure,
            .velocity = s->velocity[i],
            .reduced_velocity = m->velocity[i],
            .shift_factor = line->shift.a,
            .extrapolated_share = p->extrapolated_share,
            .total = wt_friction_total(p->hysteresis, p->area_ratio, shear, line->pressure),
            .hysteresis = p->hysteresis,
            .area_ratio = p->area_ratio};
        friction_map_add_row(t, &row);
        const double relative =
            p->hysteresis.value > 0 ? p->hysteresis.numerical_error / p->hysteresis.value : 0;
        cost->items++;
        m->n_unsettled += p->has_no_solution ? 1 : 0;
        cost->error_estimated = fmax(cost->error_estimated, relative);
        if (!p->meets_tolerance)
            m->worst = fmax(m->worst, relative);
    }
}

static wt_status compute_heated_line(const friction_map *m, const map_line *line, wt_error *err)
{
    sliding_contact c = {0};
    wt_status status = create_line_contact(m, line, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, line->pressure, m->sliding->velocity,
                                     m->sliding->n_velocity, m->points, err);
    sliding_contact_clear(&c);
    return status;
}

static void add_map_blocks(friction_map *m, const sliding_contact *c, table_writer *t,
                           cost_summary *cost)
{
    const wt_sliding *s = m->sliding;
    for (size_t k = 0; t->status == WT_OK && k < m->n_lines; k++) {
        const map_line *line = &m->lines[k];
        for (size_t i = 0; i < s->n_velocity; i++)
            m->velocity[i] = s->velocity[i] * line->shift.a;
        t->status = s->flash.on
                        ? compute_heated_line(m, line, t->err)
                        : wt_friction_compute(c->workspace, line->pressure * line->shift.b,
                                              m->velocity, s->n_velocity, m->points, t->err);
        table_block(t);
        if (t->status == WT_OK)
            add_map_rows(m, line, t, cost);
    }
}

static void set_map_keys(const friction_map *m, const sliding_contact *c, table_writer *t)
{
    const wt_sliding *s = m->sliding;
    const double reference = s->rubber->prony.reference_temperature;
    friction_map_keys keys = {.pressure = flow_stated_estimate(s->pressure),
                              .temperature = flow_stated_estimate(s->temperature),
                              .reference_temperature = {reference, (double)NAN, (double)NAN, NULL},
                              .shear_stress = flow_stated_estimate(s->shear_stress)};
    if (isnan(keys.temperature.value))
        keys.temperature.value = reference;
    (void)wt_rubber_describe(s->rubber, keys.material, sizeof keys.material);
    snprintf(keys.statement, sizeof keys.statement, "%s%s%s", m->statement,
             m->statement[0] != '\0' && c->statement[0] != '\0' ? "; " : "", c->statement);
    const size_t used = strlen(keys.statement);
    if (m->n_unsettled > 0)
        snprintf(keys.statement + used, sizeof keys.statement - used,
                 "%sno flash temperature is found at %zu points, which are nan",
                 used > 0 ? "; " : "", m->n_unsettled);
    if (m->worst > 0)
        clocale_print(keys.numerical, sizeof keys.numerical, TOLERANCE_STATEMENT,
                      m->work->tolerance, m->worst);
    friction_map_set_keys(t, &keys);
}

static wt_status tabulate_friction_map(friction_map *m, wt_table **table, wt_error *err)
{
    double range[2];
    sliding_contact c = {0};
    const wt_status status = create_reference_contact(m, range, &c, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&friction_map_schema, err);
    cost_summary cost = {.tolerance_asked = m->work->tolerance};
    add_map_blocks(m, &c, &t, &cost);
    if (t.status == WT_OK)
        set_map_keys(m, &c, &t);
    cost_report(m->work, cost);
    sliding_contact_clear(&c);
    return table_end(&t, table);
}

wt_status wt_friction_map_compute(const wt_sliding *sliding, const wt_job *work, wt_table **table,
                                  wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no friction map to make");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status != WT_OK)
        return status;
    const size_t n = sliding->n_temperatures + sliding->n_pressures;
    if (n == 0)
        return wt_fail(err, WT_E_ARG, "a friction map needs temperatures or pressures");
    friction_map m = {.sliding = sliding, .work = work, .lowest = (double)INFINITY, .highest = 0};
    m.lines = wt_alloc(n, sizeof *m.lines);
    m.velocity = wt_alloc(sliding->n_velocity, sizeof *m.velocity);
    m.points = wt_alloc(sliding->n_velocity, sizeof *m.points);
    status = list_map_lines(&m, err);
    if (status == WT_OK)
        status = tabulate_friction_map(&m, table, err);
    free(m.lines);
    free(m.velocity);
    free(m.points);
    return status;
}

/* ---- by length scale ------------------------------------------------------------------------- */

/* ---- contact area ---------------------------------------------------------------------------- */

/* Resolution of a figure. */
#define CONTACT_POINTS_PER_DECADE 20

TABLE_ROW(contact_area, CONTACT_AREA, double velocity, magnification, wavenumber;
          wt_friction_node node; double isotropic;)

/* nodes: [2 n] The second half is of the isotropic rubber, if there is such a contact. */
static void add_area_block(const sliding_contact *c, const sliding_contact *isotropic,
                           double velocity, const double *q, size_t n, wt_friction_node *nodes,
                           table_writer *t, cost_summary *cost)
{
    if (t->status == WT_OK)
        t->status = wt_friction_profile(c->workspace, c->pressure, velocity, q, n, nodes, t->err);
    if (t->status == WT_OK && isotropic != NULL)
        t->status = wt_friction_profile(isotropic->workspace, c->pressure, velocity, q, n,
                                        nodes + n, t->err);
    table_block(t);
    for (size_t i = 0; t->status == WT_OK && i < n; i++) {
        TABLE_ADD(contact_area, t, velocity, q[i] / c->roughness->q0, q[i], nodes[i],
                  isotropic != NULL ? nodes[n + i].area_ratio : (double)NAN);
        cost->items++;
        cost->error_estimated =
            fmax(cost->error_estimated, nodes[i].numerical_error / nodes[i].area_ratio);
    }
}

static void add_area_blocks(const wt_sliding *sliding, const sliding_contact *c,
                            const sliding_contact *isotropic, table_writer *t, cost_summary *cost)
{
    const double first = sliding->velocity[0], last = sliding->velocity[sliding->n_velocity - 1],
                 middle = flow_reference_velocity(sliding);
    const double decades = log10(c->roughness->q1 / c->roughness->q0);
    const size_t n = 2 + (size_t)ceil(decades * CONTACT_POINTS_PER_DECADE);
    double *q = wt_alloc(n, sizeof *q);
    wt_friction_node *nodes = wt_alloc(2 * n, sizeof *nodes);
    for (size_t i = 0; i < n; i++)
        q[i] = c->roughness->q0 * pow(10, decades * (double)i / (double)(n - 1));
    q[n - 1] = c->roughness->q1;
    add_area_block(c, isotropic, first, q, n, nodes, t, cost);
    if (middle > first && middle < last)
        add_area_block(c, isotropic, middle, q, n, nodes, t, cost);
    if (last > first)
        add_area_block(c, isotropic, last, q, n, nodes, t, cost);
    free(q);
    free(nodes);
}

/* The same rubber without its factors along the directions. */
static wt_status create_isotropic_contact(const wt_sliding *sliding, const wt_job *work,
                                          sliding_contact *contact, wt_error *err)
{
    wt_rubber rubber = *sliding->rubber;
    wt_sliding isotropic = *sliding;
    wt_job own = *work;
    rubber.is_transverse = false;
    isotropic.rubber = &rubber;
    own.drawn = NULL; /* the cache is for another material */
    return sliding_contact_create_stated(&isotropic, &own, contact, err);
}

wt_status wt_contact_area_compute(const wt_sliding *sliding, const wt_job *work, wt_table **table,
                                  wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no contact area to make");
    sliding_contact c = {0}, isotropic = {0};
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status != WT_OK)
        return status;
    const bool transverse = sliding->rubber->is_transverse;
    status = sliding_contact_create_stated(sliding, work, &c, err);
    if (status == WT_OK && transverse)
        status = create_isotropic_contact(sliding, work, &isotropic, err);
    if (status == WT_OK) {
        table_writer t = table_begin(&contact_area_schema, err);
        cost_summary cost = {.tolerance_asked = work->tolerance};
        add_area_blocks(sliding, &c, transverse ? &isotropic : NULL, &t, &cost);
        cost_report(work, cost);
        status = table_end(&t, table);
    }
    sliding_contact_clear(&isotropic);
    sliding_contact_clear(&c);
    return status;
}

TABLE_ROW(friction_decades, FRICTION_DECADES, double velocity, from, to, share;
          wt_estimate hysteresis, area_ratio; double shearing, total;)

TABLE_KEYS(friction_decades, FRICTION_DECADES, char strongest[160];)

/* Limits of the decades: q0, the powers of ten in between, q1. */
typedef struct decade_contributions {
    size_t n;
    double *q;               /* [n] */
    wt_friction_node *nodes; /* [n] */
    char strongest[160];
} decade_contributions;

static void find_decade_edges(const wt_roughness *spectrum, decade_contributions *d)
{
    /* a power of ten that differs from a limit by rounding only is that limit */
    const double slack = 1e-9;
    const int first = (int)floor(log10(spectrum->q0) + slack) + 1,
              last = (int)ceil(log10(spectrum->q1) - slack) - 1;
    const size_t inner = last >= first ? (size_t)(last - first + 1) : 0;
    d->q = wt_alloc(inner + 2, sizeof *d->q);
    d->nodes = wt_alloc(inner + 2, sizeof *d->nodes);
    d->q[d->n++] = spectrum->q0;
    for (int k = first; k <= last; k++)
        d->q[d->n++] = pow(10, k);
    d->q[d->n++] = spectrum->q1;
}

static void describe_strongest(decade_contributions *d, double velocity, size_t i, double share)
{
    char speed[32];
    wt_format_si(velocity, "m/s", 3, speed, sizeof speed);
    clocale_print(d->strongest, sizeof d->strongest,
                  "%s rad/m, wavelengths of %s um, at %s: %.0f %% of the "
                  "hysteresis friction",
                  format_range(d->q[i - 1], d->q[i], 3).text,
                  format_range(2e6 * M_PI / d->q[i], 2e6 * M_PI / d->q[i - 1], 3).text, speed,
                  100 * share);
}

static void add_decade_rows(const sliding_contact *c, decade_contributions *d, double velocity,
                            bool is_reference, table_writer *t, cost_summary *cost)
{
    double most = -1;
    if (t->status == WT_OK)
        t->status =
            wt_friction_profile(c->workspace, c->pressure, velocity, d->q, d->n, d->nodes, t->err);
    table_block(t);
    for (size_t i = 1; t->status == WT_OK && i < d->n; i++) {
        const wt_friction_node *a = &d->nodes[i - 1], *b = &d->nodes[i];
        const double all = d->nodes[d->n - 1].hysteresis;
        const double part = b->hysteresis - a->hysteresis;
        const double share = all > 0 ? part / all : (double)NAN; /* the share is undefined without
                                                                    hysteresis friction */
        const double shearing = c->shear_stress * b->area_ratio / c->pressure;
        friction_decades_row row = {
            .velocity = velocity,
            .from = d->q[i - 1],
            .to = d->q[i],
            .share = share,
            .hysteresis = {part, (double)NAN, a->hysteresis_error + b->hysteresis_error, "1"},
            .area_ratio = {b->area_ratio, (double)NAN, b->numerical_error, "1"},
            .shearing = shearing,
            .total = b->hysteresis + shearing};
        friction_decades_add_row(t, &row);
        cost->items++;
        if (all > 0)
            cost->error_estimated = fmax(cost->error_estimated, b->hysteresis_error / all);
        if (is_reference && share > most) {
            most = share;
            describe_strongest(d, velocity, i, share);
        }
    }
}

static void add_velocity_blocks(const wt_sliding *sliding, const sliding_contact *c,
                                decade_contributions *d, table_writer *t, cost_summary *cost)
{
    const double first = sliding->velocity[0], last = sliding->velocity[sliding->n_velocity - 1],
                 reference = flow_reference_velocity(sliding);
    if (first < reference)
        add_decade_rows(c, d, first, false, t, cost);
    add_decade_rows(c, d, reference, true, t, cost);
    if (last > reference)
        add_decade_rows(c, d, last, false, t, cost);
}

wt_status wt_friction_by_scale_compute(const wt_sliding *sliding, const wt_job *work,
                                       wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no decades to make");
    sliding_contact c = {0};
    decade_contributions d = {.n = 0};
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = sliding_contact_create_stated(sliding, work, &c, err);
    if (status == WT_OK) {
        find_decade_edges(c.roughness, &d);
        table_writer t = table_begin(&friction_decades_schema, err);
        cost_summary cost = {.tolerance_asked = work->tolerance};
        add_velocity_blocks(sliding, &c, &d, &t, &cost);
        friction_decades_keys keys;
        snprintf(keys.strongest, sizeof keys.strongest, "%s",
                 d.strongest[0] != '\0' ? d.strongest : "none: there is no hysteresis friction");
        friction_decades_set_keys(&t, &keys);
        cost_report(work, cost);
        status = table_end(&t, table);
    }
    sliding_contact_clear(&c);
    free(d.q);
    free(d.nodes);
    return status;
}
