/* Friction: one preparation for a material and a roughness, then G, P and mu at many velocities.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"
#include "core/base/array.h"
#include "core/base/shared_params.h"
#include "friction/numerics/persson_contact.h"

#include <math.h>
#include <stdlib.h>

/* Rule for all subintervals and rule of the check, for tolerances down to the one in the row. If
 * the first rule is too coarse for most subintervals, they are evaluated twice. 100 velocities of
 * 12 terms at 1e-10 take 0.34 ms with 12 and 17 nodes, and 0.29 ms with these. */
static const struct {
    double tolerance;
    size_t nodes[FRICTION_RULES];
} ladders[] = {{1e-5, {8, 12}}, {3e-9, {12, 17}}, {0, {15, 20}}};
/* Width for an integrand as smooth as a closed form: its poles have the distance 1.96 half widths.
 */
static const double smooth_width = 1.6;

/* Typical values of filled rubber on asphalt: Persson, J. Phys.: Condens. Matter 18 (2006) 7789. */
wt_flash wt_flash_defaults(void)
{
    return (wt_flash){
        .contact_size = 1e-3, .heat_capacity = 2.2e6, .diffusivity = 1e-7, .macroscopic = 0.3};
}

wt_friction_options wt_friction_defaults(void)
{
    return (wt_friction_options){.tolerance = DEFAULT_TOLERANCE,
                                 .gamma = 1,
                                 .layer = {.thickness = 0, .modulus_ratio = 1},
                                 .threads = 1,
                                 .strain_factor = 1,
                                 .flash = wt_flash_defaults()};
}

static const wt_param rows[] = {
    FRICTION_TOLERANCE(wt_friction_options),     FRICTION_GAMMA(wt_friction_options),
    FRICTION_STRAIN_FACTOR(wt_friction_options), LAYER_STATE_ROWS(wt_friction_options, layer.),
    PARAM_THREADS(wt_friction_options),          FLASH_ROWS(wt_friction_options, flash.),
};
PARAM_TABLE(wt_friction_params, wt_friction_options, rows, wt_friction_defaults, NO_PARTS)

/* The closed form in the core neglects the change of dmu/dG over the core, which is about its
 * length. The share of the core in mu is about the square root of its length. */
static size_t friction_core_levels(double tolerance)
{
    const double core = fmax(1e-10, 0.1 * cbrt(tolerance * tolerance));
    return (size_t)ceil(-0.5 * log2(core));
}

void friction_scratch_init(friction_scratch *scratch, const wt_friction_workspace *ws,
                           size_t n_cuts, arena *memory)
{
    *scratch = (friction_scratch){0};
    subinterval_plan_init(&scratch->plan, ws->roughness, ws->plan.width, ws->plan.levels, ws->knots,
                          ws->slopes, ws->n_knots, n_cuts, ws->softening, memory);
    const size_t subintervals = scratch->plan.capacity;
    scratch->capacity = subintervals;
    for (size_t k = 0; k < FRICTION_RULES; k++)
        grid_init(&scratch->grids[k], &scratch->plan, ws->rules[k], memory);
    double **const by_node[] = {&scratch->omega,   &scratch->log_omega, &scratch->j1,
                                &scratch->j2,      &scratch->rise,      &scratch->full,
                                &scratch->loss_j1, &scratch->loss_j2};
    const size_t n_by_node = ws->softening != NULL ? COUNT_OF(by_node) : 6;
    for (size_t i = 0; i < n_by_node; i++)
        *by_node[i] =
            arena_alloc(memory, (subintervals + 2) * GAUSS_NODES_MAX, sizeof **by_node[i]);
    scratch->knots = arena_alloc(memory, ws->n_knots + 1, sizeof *scratch->knots);
    double **const by_subinterval[] = {&scratch->bounds,        &scratch->subinterval_mu,
                                       &scratch->subinterval_g, &scratch->error_mu,
                                       &scratch->error_g,       &scratch->estimated_g,
                                       &scratch->estimated_mu,  &scratch->variance_effect};
    for (size_t i = 0; i < COUNT_OF(by_subinterval); i++)
        *by_subinterval[i] = arena_alloc(memory, subintervals + 1, sizeof **by_subinterval[i]);
    if (ws->flash != NULL)
        scratch->flash = flash_scratch_new(ws, memory);
}

static double relative_rounding(const wt_friction_workspace *ws)
{
    const strain_law *s = ws->softening;
    /* near q0 the strain depends on a rounded q - q0, which is divided among all cells */
    return s == NULL ? FRICTION_ROUNDING
                     : FRICTION_ROUNDING * s->cancellation +
                           2 * s->steepest * (8 + (double)ws->plan.levels) * DBL_EPSILON;
}

/* The modulus of a closed form has no singular point closer to a real ln q than i pi/2, the pole of
 * a Maxwell element. The modulus of a layer can have one. */
static void choose_subinterval_width(wt_friction_workspace *ws)
{
    const wt_layer_state *layer = &ws->options.layer;
    const bool is_smooth = ws->material->law->angular != NULL && ws->softening == NULL;
    const bool bulk = !(layer->thickness > 0) || (layer->modulus_ratio == 1 && ws->layer == NULL);
    subinterval_plan_init(
        &ws->plan, ws->roughness, is_smooth && bulk ? smooth_width : SUBINTERVAL_WIDTH,
        friction_core_levels(ws->options.tolerance), NULL, NULL, 0, 0, ws->softening, &ws->memory);
}

static void choose_rules(wt_friction_workspace *ws)
{
    /* between knots, subintervals are narrow */
    const size_t last = COUNT_OF(ladders) - (ws->n_knots > 0 ? 2 : 1);
    size_t ladder = 0;
    while (ladder < last && ws->options.tolerance < ladders[ladder].tolerance)
        ladder++;
    for (size_t k = 0; k < FRICTION_RULES; k++)
        ws->rules[k] = gauss_rule_get(ladders[ladder].nodes[k]);
}

/* Prepares the common plan of all velocities. */
static void prepare_plan(wt_friction_workspace *ws)
{
    double *bounds = arena_alloc(&ws->memory, ws->plan.capacity + 1, sizeof *bounds);
    subinterval_plan_fill(&ws->plan, ws->roughness, NULL, 0, NULL, 0, bounds);
}

static wt_status init_softening(wt_friction_workspace *ws, wt_error *err)
{
    const wt_friction_options *o = &ws->options;
    const wt_status status = softening_new(o->softening, o->strain_factor, ws->material,
                                           ws->roughness, &ws->memory, &ws->softening, err);
    ws->options.softening = NULL; /* the table was borrowed for this call only */
    if (status == WT_OK)
        ws->loss = angular_new(&ws->softening->loss, ws->options.tolerance, &ws->memory);
    return status;
}

/* Prepares a layer with its own moduli, which are then part of J1 and J2. Subintervals end where
 * its moduli are not smooth. */
static wt_status init_layer_moduli(wt_friction_workspace *ws, wt_error *err)
{
    wt_layer_state *layer = &ws->options.layer;
    if (!layer_has_moduli(layer))
        return WT_OK;
    ws->layer = arena_alloc(&ws->memory, 1, sizeof *ws->layer);
    const wt_status status =
        layer_slope_shift(&ws->options.shift, ws->options.temperature, &layer->slope, err);
    if (status != WT_OK)
        return status;
    *ws->layer = layer_moduli_create(ws->material, *layer, ws->options.tolerance);
    const size_t more = ws->layer->n_edges;
    *layer = (wt_layer_state){.thickness = layer->thickness, .modulus_ratio = 1};
    double *all = arena_numbers(&ws->memory, ws->n_knots + more);
    for (size_t k = 0; k < ws->n_knots + more; k++)
        all[k] = k < ws->n_knots ? ws->knots[k] : ws->layer->edges[k - ws->n_knots];
    numbers_sort(all, ws->n_knots + more);
    ws->knots = all;
    ws->n_knots += more;
    return WT_OK;
}

/* Prepares the data of the knots for the plans. */
static void prepare_knots(wt_friction_workspace *ws)
{
    if (ws->n_knots == 0)
        return;
    ws->slopes = arena_numbers(&ws->memory, ws->n_knots + 1);
    ws->log_knots = arena_numbers(&ws->memory, ws->n_knots);
    material_slopes(ws->material, ws->knots, ws->n_knots, ws->slopes);
    for (size_t k = 0; k < ws->n_knots; k++)
        ws->log_knots[k] = log(ws->knots[k]);
}

wt_status wt_friction_workspace_new(const wt_material *material, const wt_roughness *roughness,
                                    const wt_friction_options *options,
                                    wt_friction_workspace **workspace, wt_error *err)
{
    if (material == NULL || roughness == NULL || workspace == NULL)
        return wt_fail(err, WT_E_ARG, "friction needs a material and a power spectrum");
    const wt_friction_options o = options ? *options : wt_friction_defaults();
    wt_status status = param_check(wt_friction_params(), &o, err);
    if (status != WT_OK)
        return status;
    wt_friction_workspace *ws = wt_alloc(1, sizeof *ws);
    ws->material = material;
    ws->roughness = roughness;
    ws->options = o;
    ws->stiffness = 1 / (1 - material->poisson_ratio * material->poisson_ratio);
    if (material->law->breaks != NULL && material->law->angular == NULL)
        ws->knots = material->law->breaks(material, &ws->n_knots);
    ws->threads = wt_thread_count(o.threads);
    ws->scratch = arena_alloc(&ws->memory, ws->threads, sizeof *ws->scratch);
    status = init_layer_moduli(ws, err);
    prepare_knots(ws);
    if (status == WT_OK && o.softening != NULL)
        status = init_softening(ws, err);
    choose_subinterval_width(ws);
    if (status == WT_OK) {
        ws->angular = o.series != NULL ? o.series : angular_new(material, o.tolerance, &ws->memory);
        choose_rules(ws);
        ws->rounding = relative_rounding(ws);
    }
    if (status == WT_OK && o.flash.on)
        status = flash_new(ws, err);
    if (status == WT_OK && ws->n_knots == 0)
        prepare_plan(ws);
    for (unsigned i = 0; status == WT_OK && i < ws->threads; i++)
        friction_scratch_init(&ws->scratch[i], ws, 0, &ws->memory);
    if (status != WT_OK) {
        wt_friction_workspace_free(ws);
        return status;
    }
    *workspace = ws;
    return WT_OK;
}

void wt_friction_workspace_free(wt_friction_workspace *ws)
{
    if (ws == NULL)
        return;
    if (ws->options.series == NULL)
        angular_clear(ws->angular);
    angular_clear(ws->loss);
    arena_free(&ws->memory);
    free(ws);
}

size_t friction_node_count(const wt_friction_workspace *ws)
{
    size_t nodes = 0;
    for (unsigned i = 0; i < ws->threads; i++)
        nodes += ws->scratch[i].nodes;
    return nodes;
}

/* Other threads may read a shared series. If it does not cover the range, the workspace creates its
 * own series. */
static void replace_shared_series(wt_friction_workspace *ws, double lowest, double highest)
{
    if (ws->options.series == NULL || angular_covers_range(ws->angular, lowest, highest))
        return;
    ws->angular = angular_new(ws->material, ws->options.tolerance, &ws->memory);
    ws->options.series = NULL;
}

/* Factor of the lowest frequency for the hottest possible rubber. */
static double min_frequency_factor(const wt_friction_workspace *ws)
{
    double log_shift = 0;
    if (ws->flash != NULL)
        flash_log_shift(ws->flash, &ws->flash->hottest, 1, &log_shift);
    return exp(log_shift);
}

wt_status friction_prepare(wt_friction_workspace *ws, double pressure, const double *velocity,
                           size_t n, wt_error *err)
{
    if (!(pressure > 0) || !isfinite(pressure))
        return range_error("pressure", pressure, "finite and > 0 Pa", err);
    double slowest = (double)INFINITY, fastest = 0, least = (double)INFINITY;
    for (size_t i = 0; i < n; i++) {
        const double speed = fabs(velocity[i]);
        if (!isfinite(speed))
            return range_error("velocity", velocity[i], "finite, in m/s", err);
        least = fmin(least, speed);
        if (speed > 0)
            slowest = fmin(slowest, speed); /* velocity 0 uses the closed form */
        fastest = fmax(fastest, speed);
    }
    const wt_material *material = ws->material;
    const double shift = min_frequency_factor(ws);
    const double lowest = (isfinite(slowest) ? slowest : 0) * ws->roughness->q0 * shift;
    const double highest = fastest * ws->roughness->q1;
    if (n == 0)
        return WT_OK;
    wt_status status = WT_OK;
    if (!material->law->angular &&
        !(least * ws->roughness->q0 * shift >= ANGULAR_MIN_FREQUENCY && highest <= DBL_MAX)) {
        (void)range_error("velocity", highest <= DBL_MAX ? least : fastest,
                          "not 0, and so that q v is a frequency in range", err);
        wt_error_advice(err, "a material of kind %s has no static limit; a Prony series has one",
                        material->law->name);
        return WT_E_RANGE;
    }
    if (!material->law->angular && material->law->check != NULL)
        status = material->law->check(material, lowest, highest, NULL, err);
    if (status != WT_OK)
        return status;
    replace_shared_series(ws, lowest, highest);
    angular_extend(ws->angular, lowest, highest);
    if (ws->softening != NULL)
        angular_extend(ws->loss, lowest, highest);
    return WT_OK;
}

friction_load friction_load_create(const wt_friction_workspace *ws, double pressure,
                                   double velocity)
{
    const double speed = fabs(velocity);
    return (friction_load){
        .pressure = pressure, .speed = speed, .log_lowest = log(ws->roughness->q0) + log(speed)};
}

const subinterval_plan *friction_plan(const wt_friction_workspace *ws, friction_scratch *scratch,
                                      const friction_load *at, const double *cuts, size_t n_cuts)
{
    if (!ws->n_knots && !n_cuts)
        return &ws->plan;
    for (size_t k = 0; k < ws->n_knots; k++)
        scratch->knots[k] = ws->log_knots[k] - at->log_lowest;
    if (at->heat != NULL)
        friction_shift_knots(ws, &at->heat->heat, scratch->knots);
    subinterval_plan_fill(&scratch->plan, ws->roughness, cuts, n_cuts, scratch->knots, ws->n_knots,
                          scratch->bounds);
    for (size_t k = 0; k < FRICTION_RULES; k++)
        grid_reset(&scratch->grids[k], &scratch->plan);
    return &scratch->plan;
}

friction_relative friction_relative_error(const wt_friction_workspace *ws,
                                          const friction_pass *pass, friction_load at)
{
    /* J2 grows at most with the square of the frequency, J1 linearly; P depends on G as stated for
     * FRICTION_AREA_POWER */
    const double shifted =
        at.heat != NULL ? at.heat->steepest * friction_heat_error(at.heat, pass) : 0;
    const double of_g = 2 * shifted, of_mu = shifted + FRICTION_AREA_POWER * of_g;
    friction_relative e = {ws->rounding + of_g, ws->rounding + of_mu};
    if (pass->variance > 0)
        e.variance += pass->variance_input_error / pass->variance;
    if (pass->hysteresis > 0)
        e.hysteresis += pass->hysteresis_input_error / pass->hysteresis;
    return e;
}

/* ---- velocities ------------------------------------------------------------------------------ */

static wt_estimate dimensionless_estimate(double value, double error)
{
    return (wt_estimate){.value = value, .numerical_error = error, .unit = "1"};
}

typedef struct compute_job {
    const wt_friction_workspace *ws;
    double pressure;
    const double *velocity;
    size_t n;
    wt_friction_point *points;
} compute_job;

static bool needs_extrapolated_share(const wt_friction_workspace *ws)
{
    return !ws->options.skip_extrapolated_share &&
           (ws->layer != NULL || ws->material->frequency_min > 0 ||
            ws->material->frequency_max > 0);
}

/* Computes a load with known temperatures, for a positive velocity. */
static void compute_load(const wt_friction_workspace *ws, friction_scratch *scratch,
                         const friction_load *at, wt_friction_point *point)
{
    const double tolerance = ws->options.tolerance;
    const subinterval_plan *plan = friction_plan(ws, scratch, at, NULL, 0);
    friction_pass pass;
    friction_evaluate(ws, scratch, plan, (friction_effort){0}, *at, needs_extrapolated_share(ws),
                      NULL, &pass);
    const friction_relative relative = friction_relative_error(ws, &pass, *at);
    const double error_g = relative.variance * pass.variance + pass.variance_error;
    const double error_mu = relative.hysteresis * pass.hysteresis + pass.hysteresis_error;
    const double area = contact_area(pass.variance);
    const double error_area = contact_area_error(pass.variance, error_g);
    point->stress_variance = dimensionless_estimate(pass.variance, error_g);
    point->area_ratio = dimensionless_estimate(area, error_area);
    point->one_minus_area = dimensionless_estimate(contact_gap(pass.variance),
                                                   contact_gap_error(pass.variance, error_g));
    point->hysteresis = dimensionless_estimate(pass.hysteresis, error_mu);
    if (at->heat != NULL)
        point->temperature = (wt_estimate){.value = ws->options.temperature + at->heat->rise,
                                           .numerical_error = friction_heat_error(at->heat, &pass),
                                           .unit = "K"};
    point->nodes = pass.nodes;
    point->meets_tolerance = error_g <= tolerance * pass.variance &&
                             error_area <= tolerance * area &&
                             error_mu <= tolerance * pass.hysteresis;
    point->extrapolated_share = ws->options.skip_extrapolated_share ? (double)NAN
                                : pass.hysteresis > 0 ? fmin(pass.outside / pass.hysteresis, 1)
                                                      : 0;
}

static void compute_point(const compute_job *job, friction_scratch *scratch, double velocity,
                          wt_friction_point *point)
{
    const wt_friction_workspace *ws = job->ws;
    friction_load at = friction_load_create(ws, job->pressure, velocity);
    const double sign = velocity < 0 ? -1 : velocity > 0 ? 1 : 0;
    if (ws->flash == NULL || sign == 0) {
        compute_load(ws, scratch, &at, point);
        point->temperature = dimensionless_estimate((double)NAN, (double)NAN);
        point->has_no_solution = false;
    } else {
        friction_heated_point(ws, scratch, at, compute_load, point);
    }
    point->velocity = velocity;
    point->hysteresis.value *= sign;
}

static wt_status compute_velocity(void *user, size_t i, unsigned worker)
{
    const compute_job *job = user;
    wt_friction_point *point = &job->points[i];
    compute_point(job, &job->ws->scratch[worker], job->velocity[i], point);
    const bool number = isfinite(point->stress_variance.value) && isfinite(point->hysteresis.value);
    return number || point->has_no_solution ? WT_OK : WT_E_RANGE;
}

wt_status wt_friction_compute(wt_friction_workspace *workspace, double pressure,
                              const double *velocity, size_t n, wt_friction_point *points,
                              wt_error *err)
{
    if (workspace == NULL || velocity == NULL || points == NULL)
        return wt_fail(err, WT_E_ARG, "friction needs velocities and a place for the results");
    wt_status status = friction_prepare(workspace, pressure, velocity, n, err);
    if (status != WT_OK)
        return status;
    compute_job job = {
        .ws = workspace, .pressure = pressure, .velocity = velocity, .n = n, .points = points};
    status = wt_parallel_for(n, workspace->threads, compute_velocity, &job, NULL, "friction");
    if (status == WT_E_RANGE) {
        (void)range_error("pressure", pressure,
                          "so high that the stress variance G stays finite, in Pa", err);
        wt_error_advice(err, "check the units of pressure, moduli and power spectrum");
        return status;
    }
    return status == WT_OK ? WT_OK : wt_fail(err, status, "the friction integral could not be run");
}

double wt_friction_layer_ratio(const wt_friction_workspace *workspace, double omega)
{
    return workspace->layer != NULL ? layer_moduli_ratio(workspace->layer, omega)
                                    : workspace->options.layer.modulus_ratio;
}

wt_estimate wt_friction_total(wt_estimate hysteresis, wt_estimate area_ratio,
                              wt_estimate shear_stress, double pressure)
{
    const double per_area = shear_stress.value / pressure;
    const double per_stress = area_ratio.value / pressure;
    return (wt_estimate){.value = hysteresis.value + per_area * area_ratio.value,
                         .standard_error = hypot(hysteresis.standard_error,
                                                 hypot(per_area * area_ratio.standard_error,
                                                       per_stress * shear_stress.standard_error)),
                         .numerical_error = hysteresis.numerical_error +
                                            fabs(per_area) * area_ratio.numerical_error +
                                            fabs(per_stress) * shear_stress.numerical_error,
                         .unit = "1"};
}

/* ---- running profile ------------------------------------------------------------------------- */

static wt_status check_wavenumbers(const wt_roughness *roughness, const double *q, size_t n,
                                   wt_error *err)
{
    for (size_t i = 0; i < n; i++)
        if (!(q[i] >= (i ? q[i - 1] : roughness->q0) && q[i] <= roughness->q1)) {
            wt_fail(err, WT_E_RANGE, "wavenumber %zu of %zu of a friction profile is out of range",
                    i + 1, n);
            wt_error_expected(err, "rising, from q0 = %g to q1 = %g rad/m", roughness->q0,
                              roughness->q1);
            wt_error_found(err, "%g", q[i]);
            return WT_E_RANGE;
        }
    return WT_OK;
}

/* Computes running sums to each wavenumber, with subintervals that end there. The capacity of cuts
 * is n. */
static void fill_nodes(const wt_friction_workspace *workspace, friction_load at, double sign,
                       friction_scratch *scratch, const double *wavenumber, size_t n, double *cuts,
                       wt_friction_node *nodes)
{
    const wt_roughness *roughness = workspace->roughness;
    for (size_t i = 0; i < n; i++)
        cuts[i] = log1p((wavenumber[i] - roughness->q0) / roughness->q0);
    const subinterval_plan *plan = friction_plan(workspace, scratch, &at, cuts, n);
    friction_pass pass;
    const friction_effort effort = {.accurate_everywhere = true};
    friction_evaluate(workspace, scratch, plan, effort, at, false, NULL, &pass);

    const friction_relative relative = friction_relative_error(workspace, &pass, at);
    const double slack = 1e-13 * fmax(1, log(roughness->q1 / roughness->q0));
    const size_t first = plan->levels - pass.level;
    double variance = 0, difference = 0, hysteresis = 0, error = 0;
    size_t part = 0; /* the next part; part p ends at end[p] */
    for (size_t i = 0; i < n; i++) {
        while (part < pass.parts) {
            const double end = part == 0 ? plan->core[pass.level].t_high
                                         : plan->subintervals[first + part - 1].t_high;
            if (end > cuts[i] + slack * (cuts[i] > slack))
                break;
            variance += scratch->subinterval_g[part];
            hysteresis += scratch->subinterval_mu[part];
            difference += scratch->error_g[part];
            error += scratch->error_mu[part];
            part++;
        }
        nodes[i] = (wt_friction_node){.wavenumber = wavenumber[i],
                                      .stress_variance = variance,
                                      .area_ratio = contact_area(variance),
                                      .hysteresis = sign * hysteresis,
                                      .numerical_error = contact_area_error(
                                          variance, difference + relative.variance * variance),
                                      .hysteresis_error = error + relative.hysteresis * hysteresis,
                                      .temperature = (double)NAN};
        if (at.heat != NULL) {
            heat_rise(&at.heat->heat, &wavenumber[i], 1, &nodes[i].temperature);
            nodes[i].temperature += workspace->options.temperature;
        }
    }
}

wt_status wt_friction_profile(wt_friction_workspace *workspace, double pressure, double velocity,
                              const double *wavenumber, size_t n, wt_friction_node *nodes,
                              wt_error *err)
{
    if (workspace == NULL || (n && (wavenumber == NULL || nodes == NULL)))
        return wt_fail(err, WT_E_ARG, "a friction profile needs wavenumbers and a place for it");
    const wt_roughness *roughness = workspace->roughness;
    wt_status status = friction_prepare(workspace, pressure, &velocity, 1, err);
    if (status == WT_OK)
        status = check_wavenumbers(roughness, wavenumber, n, err);
    if (status != WT_OK || n == 0)
        return status;

    friction_load at = friction_load_create(workspace, pressure, velocity);
    friction_scratch scratch;
    arena memory = {0};
    double *cuts = arena_alloc(&memory, n, sizeof *cuts);
    friction_scratch_init(&scratch, workspace, n, &memory);
    status = friction_solve_heat(workspace, &scratch, &at, err);
    if (status == WT_OK)
        fill_nodes(workspace, at,
                   velocity < 0   ? -1
                   : velocity > 0 ? 1
                                  : 0,
                   &scratch, wavenumber, n, cuts, nodes);
    workspace->scratch[0].nodes += scratch.nodes;
    arena_free(&memory);
    return status;
}
