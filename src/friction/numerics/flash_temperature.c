/* Preparation of a flash temperature: nodes, lattices and the factors of its kernel.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/flash_temperature.h"
#include "friction/numerics/friction_kernel.h"

#include "core/base/array.h"
#include "core/base/param.h"
#include "core/math/simd.h"

#include <math.h>

/* Nodes of a subinterval and steps of the lattice, for tolerances down to the one in the row. */
static const struct {
    double tolerance;
    size_t nodes;
    double step;
} ladders[] = {{1e-4, 5, 0.4}, {1e-6, 6, 0.32}, {1e-8, 7, 0.27}, {1e-11, 12, 0.18}, {0, 18, 0.14}};

/* Below this tolerance, rounding dominates. */
static const double min_tolerance = 1e-13;
/* Cells towards q0. The heat that a core neglects is of the order of its length. */
static const double core_share = 0.1;
enum { MIN_LEVELS = 3, MAX_LEVELS = 12 };

/* Rubber is destroyed above this temperature [K]; a hotter solution is not valid. */
static const double hottest = 573.15;

void flash_log_shift(const flash_law *law, const double *rise, size_t n, double *log_shift)
{
    const wt_shift_law *shift = &law->shift;
    const wt_wlf *wlf = &shift->wlf;
    /* relative to T0, so that small rises keep their digits */
    const double c2 = wlf->c2 + law->temperature - wlf->reference_temperature;
    const double c1 = M_LN10 * wlf->c1 * wlf->c2 / c2;
    if (shift->kind == WT_LAW_WLF)
        for (size_t i = 0; i < n; i++)
            log_shift[i] = -c1 * rise[i] / (c2 + rise[i]);
    else
        for (size_t i = 0; i < n; i++)
            log_shift[i] =
                M_LN10 * wt_shift_law_log_a(shift, law->temperature + rise[i]) - law->log_a;
}

/* ---- use of a profile ------------------------------------------------------------------------ */

WIDE_REGISTERS
static void add_wave_rises(const double *restrict square, const double *restrict amount,
                           size_t n_waves, const double *restrict of_q, size_t n,
                           double *restrict rise)
{
    for (size_t j = 0; j < n_waves; j++) {
        const double here = square[j], part = amount[j];
        for (size_t i = 0; i < n; i++)
            rise[i] += part * (of_q[i] / (here + of_q[i]));
    }
}

void heat_rise(const heat_profile *heat, const double *q, size_t n, double *rise)
{
    for (size_t from = 0, count; from < n; from += count) {
        double of_q[GAUSS_NODES_MAX];
        count = n - from < GAUSS_NODES_MAX ? n - from : GAUSS_NODES_MAX;
        for (size_t i = 0; i < count; i++) {
            of_q[i] = 4 * q[from + i] * q[from + i];
            rise[from + i] = heat->constant;
        }
        add_wave_rises(heat->square, heat->amount, heat->n, of_q, count, rise + from);
    }
}

void heat_log_shift(const heat_profile *heat, const double *q, size_t n, double *log_shift)
{
    heat_rise(heat, q, n, log_shift);
    for (size_t i = 0; i < n; i++)
        log_shift[i] = fmin(log_shift[i], heat->law->hottest);
    flash_log_shift(heat->law, log_shift, n, log_shift);
}

/* ---- nodes ----------------------------------------------------------------------------------- */

static void copy_nodes(flash_grid *grid, const double *q, const double *factor1,
                       const double *factor2, const double *f, const double *g, double half)
{
    const size_t n = grid->rule->n, at = grid->n;
    for (size_t i = 0; i < n; i++) {
        grid->q[at + i] = q[i];
        grid->log_q[at + i] = log(q[i]);
        grid->weight[at + i] = grid->rule->weight[i];
        grid->factor1[at + i] = half * factor1[i];
        grid->factor2[at + i] = half * factor2[i];
        if (grid->f != NULL && f != NULL) {
            grid->f[at + i] = f[i];
            grid->g[at + i] = g[i];
        }
    }
    grid->n += n;
    grid->n_subintervals++;
}

static void fill_grid(const wt_friction_workspace *ws, flash_grid *grid,
                      const subinterval_plan *plan, arena *memory)
{
    scale_grid all;
    arena local_memory = {0};
    grid_init(&all, plan, grid->rule, &local_memory);
    const size_t capacity = (plan->n_subintervals + 1) * grid->rule->n;
    double **const numbers[] = {&grid->q,       &grid->log_q, &grid->weight, &grid->factor1,
                                &grid->factor2, &grid->f,     &grid->g};
    const size_t n_numbers = ws->softening != NULL ? COUNT_OF(numbers) : 5;
    for (size_t i = 0; i < n_numbers; i++)
        *numbers[i] = arena_numbers(memory, capacity);
    const size_t core = plan->levels * grid->rule->n;
    const wt_layer_state *layer = &ws->options.layer;
    grid_fill_core(&all, plan, plan->levels, ws->roughness, layer);
    grid_fill_subintervals(&all, plan, 0, plan->n_subintervals, ws->roughness, layer);
    const bool soft = all.f != NULL;
    copy_nodes(grid, all.core_q + core, all.core_factor1 + core, all.core_factor2 + core,
               soft ? all.core_f + core : NULL, soft ? all.core_g + core : NULL,
               all.core_half_width[plan->levels]);
    for (size_t p = 0; p < plan->n_subintervals; p++) {
        const size_t at = p * grid->rule->n;
        copy_nodes(grid, all.q + at, all.factor1 + at, all.factor2 + at, soft ? all.f + at : NULL,
                   soft ? all.g + at : NULL, all.half_width[p]);
    }
    arena_free(&local_memory);
}

/* ---- lattices -------------------------------------------------------------------------------- */

/* The lattice ends at the k where the factor 4 q / (k^2 + 4 q^2) of any q differs by exp(-digits)
 * from that of k = 0. */
static void create_lattice(const flash_law *law, flash_grid *grid, double digits, arena *memory)
{
    const size_t n = grid->n;
    const double last = log(law->q0) - 0.5 * digits;
    const size_t n_k = flash_padded_rows(1 + (size_t)((grid->first - last) / grid->step));
    grid->square = arena_numbers(memory, n_k);
    grid->in = arena_numbers(memory, n_k * flash_padded_rows(n));
    grid->out = arena_numbers(memory, n_k * n);
    grid->n_k = n_k;
    for (size_t j = 0; j < n_k; j++) {
        const double k = exp(grid->first - (double)j * grid->step);
        grid->square[j] = k * k;
        for (size_t i = 0; i < n; i++) {
            const double q = grid->q[i], lorentz = 4 * q / (k * k + 4 * q * q);
            grid->in[i * n_k + j] = lorentz;
            grid->out[j * n + i] = lorentz * q;
        }
    }
}

/* ---- the grid -------------------------------------------------------------------------------- */

static size_t flash_core_levels(double tolerance)
{
    const double levels = ceil(-0.5 * log2(core_share * cbrt(tolerance)));
    return (size_t)fmin(fmax(levels, MIN_LEVELS), MAX_LEVELS);
}

static void create_grid(wt_friction_workspace *ws, flash_law *law)
{
    arena local_memory = {0};
    subinterval_plan plan;
    size_t ladder = 0;
    while (law->tolerance < ladders[ladder].tolerance)
        ladder++;
    subinterval_plan_init(&plan, ws->roughness, SUBINTERVAL_WIDTH,
                          flash_core_levels(law->tolerance), NULL, NULL, 0, 0, ws->softening,
                          &local_memory);
    double *bounds = arena_numbers(&local_memory, plan.capacity + 1);
    subinterval_plan_fill(&plan, ws->roughness, NULL, 0, NULL, 0, bounds);
    flash_grid *grid = &law->grid;
    const double digits = -log(fmax(law->tolerance, min_tolerance));
    grid->step = ladders[ladder].step;
    grid->below = digits + 3; /* the neglected part falls as k below the lattice; above it as
                                 k^-5, or k^-3 where the heat stays where it is made */
    grid->first = log(ws->roughness->q1) + grid->below / 3;
    grid->rule = gauss_rule_get(ladders[ladder].nodes);
    fill_grid(ws, grid, &plan, &ws->memory);
    create_lattice(law, grid, digits, &ws->memory);
    arena_free(&local_memory);
}

/* ---- construction ---------------------------------------------------------------------------- */

static wt_status check_shift_law(const wt_friction_options *o, wt_error *err)
{
    if (o->shift.kind == WT_LAW_NONE) {
        (void)wt_fail(err, WT_E_MISSING, "a flash temperature needs the shift law of the material");
        wt_error_advice(err, "give WLF constants, or DMA isotherms at several temperatures");
        return WT_E_MISSING;
    }
    if (!(o->temperature > 0) || !(o->temperature < hottest))
        return range_error("temperature of the surroundings", o->temperature,
                           "below 573 K, above which rubber is destroyed", err);
    if (isnan(wt_shift_law_log_a(&o->shift, o->temperature)))
        return range_error("temperature of the surroundings", o->temperature,
                           "one at which the shift law has a value", err);
    return WT_OK;
}

wt_status flash_new(wt_friction_workspace *ws, wt_error *err)
{
    const wt_friction_options *o = &ws->options;
    wt_status status = check_shift_law(o, err);
    if (status != WT_OK)
        return status;
    flash_law *law = arena_alloc(&ws->memory, 1, sizeof *law);
    law->options = o->flash;
    law->shift = o->shift;
    law->temperature = o->temperature;
    law->log_a = M_LN10 * wt_shift_law_log_a(&law->shift, law->temperature);
    law->hottest = hottest - o->temperature;
    law->tolerance = o->tolerance;
    law->q0 = ws->roughness->q0;
    ws->flash = law;
    create_grid(ws, law);
    return WT_OK;
}
