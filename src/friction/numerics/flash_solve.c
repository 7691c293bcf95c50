/* Self-consistent temperatures by Anderson mixing.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"

#include "core/base/array.h"
#include "core/math/cholesky.h"
#include "core/math/simd.h"
#include "friction/numerics/persson_contact.h"

#include <math.h>
#include <string.h>

/* Number of stored steps of the mixing, and the share of the residual that a step takes. The full
 * residual is fastest. Plain steps diverge where heat lowers friction so steeply that the map
 * changes its order, and mixed steps may wander there. */
enum { DEPTH = 5 };
static const double damping = 0.5;
/* Far from a solution the first steps are plain steps with stronger damping. They converge up to a
 * map slope of -7. */
enum { DAMPED_MAPS = 12 };
static const double strong_damping = 0.25;
/* A smooth solution needs at most the first number of maps; an existing one is found within the
 * second. */
enum { FREE_MAPS = 15, MAX_MAPS = 60 };
/* Error of a first solution relative to the largest rise. */
static const double first_tolerance = 1e-5;
/* Share of the tolerance that a residual may have in ln a_T. */
static const double goal_share = 0.05;
/* Number of waves in a batch, for whole registers. */
enum { WAVE_BATCH = 32 };
/* Differences below this are rounding and carry no information. */
static const double min_pivot = 1e-10;

struct flash_scratch {
    double *rise, *next, *residual;         /* [nodes] rise above T0, its map and the residual */
    double *last_rise, *last_residual;      /* values of the previous step */
    double *steps, *changes;                /* [DEPTH * nodes] differences of the rise and of the
                                               residual */
    double *shift, *omega, *x, *j1, *j2;    /* [nodes] */
    double *loss_j1, *loss_j2;              /* [nodes] with softening */
    double *g, *running, *area, *mu, *heat; /* [nodes] */
    double *wave, *square, *sum;            /* [waves] */
    double *amount;                         /* [waves] */
    size_t nodes;
};

flash_scratch *flash_scratch_new(const wt_friction_workspace *ws, arena *memory)
{
    flash_scratch *s = arena_alloc(memory, 1, sizeof *s);
    const size_t n = flash_padded_rows(ws->flash->grid.n) + GAUSS_NODES_MAX;
    double **const by_node[] = {
        &s->rise,  &s->next,    &s->residual, &s->last_rise, &s->last_residual, &s->shift,
        &s->omega, &s->x,       &s->j1,       &s->j2,        &s->loss_j1,       &s->loss_j2,
        &s->g,     &s->running, &s->area,     &s->mu,        &s->heat};
    for (size_t i = 0; i < COUNT_OF(by_node); i++)
        *by_node[i] = arena_numbers(memory, n);
    s->steps = arena_numbers(memory, DEPTH * n);
    s->changes = arena_numbers(memory, DEPTH * n);
    double **const by_wave[] = {&s->wave, &s->square, &s->sum, &s->amount};
    for (size_t i = 0; i < COUNT_OF(by_wave); i++)
        *by_wave[i] = arena_numbers(memory, ws->flash->grid.n_k);
    return s;
}

size_t flash_reset_node_count(flash_scratch *scratch)
{
    const size_t nodes = scratch->nodes;
    scratch->nodes = 0;
    return nodes;
}

/* ---- the temperature map --------------------------------------------------------------------- */

typedef struct flash_map {
    const wt_friction_workspace *ws;
    const flash_law *law;
    flash_scratch *s;
    const flash_grid *grid;
    friction_load at;
    double part;     /* share of the heat */
    double longest;  /* sum of the waves beyond the lattice */
    double constant; /* rise due to these waves */
} flash_map;

/* sum[i] += factor[r] rows[r][i]; the number of rows is a multiple of FLASH_ROWS. */
WIDE_REGISTERS
static void add_matrix_rows(const double *restrict rows, size_t stride, size_t n_rows, size_t n,
                            const double *restrict factor, double *restrict sum)
{
    for (size_t r = 0; r < n_rows; r += FLASH_ROWS) {
        const double *a = rows + r * stride, *b = a + stride, *c = b + stride, *d = c + stride;
        const double fa = factor[r], fb = factor[r + 1], fc = factor[r + 2], fd = factor[r + 3];
        for (size_t i = 0; i < n; i++)
            sum[i] += (fa * a[i] + fb * b[i]) + (fc * c[i] + fd * d[i]);
    }
}

/* Weights dk m(k) / pi of the waves from the `first` on. */
static void fill_wave_weights(const flash_map *map, double tau, size_t first, size_t n,
                              double *wave)
{
    double exponent[WAVE_BATCH];
    const double diffusivity = map->law->options.diffusivity, step = map->grid->step;
    for (size_t from = 0, count; from < n; from += count) {
        count = n - from < WAVE_BATCH ? n - from : WAVE_BATCH;
        double k = exp(map->grid->first - (double)(first + from) * step);
        const double ratio = exp(-step);
        double scale[WAVE_BATCH];
        for (size_t j = 0; j < count; j++, k *= ratio) {
            exponent[j] = -k * k * tau;
            scale[j] = -step / (M_PI * diffusivity * k);
        }
        vector_expm1(exponent, count, wave + from);
        for (size_t j = 0; j < count; j++)
            wave[from + j] *= scale[j];
    }
}

/* Sum of the waves beyond the lattice, down to where they are negligible. */
static double sum_long_waves(const flash_map *map, double tau)
{
    const flash_grid *grid = map->grid;
    const double lowest = fmin(log(map->law->q0), -0.5 * log(tau)) - grid->below;
    const double count = (grid->first - lowest) / grid->step - (double)grid->n_k;
    double wave[WAVE_BATCH], sum = 0;
    const size_t left = count > 0 ? (size_t)count : 0;
    for (size_t from = 0, n; from < left; from += n) {
        n = left - from < WAVE_BATCH ? left - from : WAVE_BATCH;
        fill_wave_weights(map, tau, grid->n_k + from, n, wave);
        for (size_t j = 0; j < n; j++)
            sum += wave[j];
    }
    return sum;
}

static flash_map create_map(const wt_friction_workspace *ws, flash_scratch *s,
                            const friction_load *at)
{
    const flash_law *law = ws->flash;
    flash_map map = {.ws = ws, .law = law, .s = s, .grid = &law->grid, .at = *at, .part = 1};
    const double tau = law->options.diffusivity * law->options.contact_size / at->speed;
    fill_wave_weights(&map, tau, 0, map.grid->n_k, s->wave);
    map.longest = sum_long_waves(&map, tau);
    return map;
}

/* J1 and J2 at the current temperatures. */
static void compute_moduli(const flash_map *map)
{
    flash_scratch *s = map->s;
    const flash_grid *grid = map->grid;
    const wt_friction_workspace *ws = map->ws;
    const double log_speed = log(map->at.speed);
    flash_log_shift(map->law, s->rise, grid->n, s->shift);
    vector_exp(s->shift, grid->n, s->omega);
    for (size_t i = 0; i < grid->n; i++) {
        s->omega[i] *= grid->q[i] * map->at.speed;
        s->x[i] = grid->log_q[i] + log_speed + s->shift[i];
    }
    double ignored_error = 0; /* the pass at these temperatures reports this error */
    friction_moduli(ws, grid->q, s->omega, s->x, grid->n, s->j1, s->j2, s->loss_j1, s->loss_j2,
                    &ignored_error);
    s->nodes += grid->n;
    if (ws->loss == NULL)
        return;
    for (size_t i = 0; i < grid->n; i++) {
        const double f = grid->f[i], g = grid->g[i];
        s->j1[i] *= g;
        s->j2[i] = f * f * s->j2[i] + (g - f) * (g + f) * s->loss_j2[i];
    }
}

/* Computes P, the contributions to mu without weights, and the heat. */
static void compute_heat(const flash_map *map)
{
    flash_scratch *s = map->s;
    const flash_grid *grid = map->grid;
    const wt_friction_options *o = &map->ws->options;
    const size_t n = grid->rule->n;
    const double ratio = map->ws->stiffness / map->at.pressure;
    double variance = 0;
    for (size_t i = 0; i < grid->n; i++)
        s->g[i] = 0.125 * ratio * ratio * grid->factor2[i] * s->j2[i];
    for (size_t p = 0; p < grid->n_subintervals; p++) {
        double *running = s->running + p * n;
        for (size_t i = 0; i < grid->rule->row_stride; i++)
            running[i] = variance;
        const double part = gauss_rule_integrate(grid->rule, s->g + p * n, running);
        for (size_t i = 0; i < n; i++)
            running[i] = fmax(running[i], i > 0 ? running[i - 1] : variance);
        variance = fmax(variance + part, running[n - 1]);
    }
    contact_areas(s->running, grid->n, s->area);
    const double macroscopic = map->law->options.macroscopic, gamma = o->gamma;
    const double per_mu =
        2 * map->part * map->at.pressure * map->at.speed / map->law->options.heat_capacity;
    for (size_t i = 0; i < grid->n; i++) {
        const double area = s->area[i], partial = gamma + (1 - gamma) * area * area;
        s->mu[i] = 0.5 * ratio * grid->factor1[i] * s->j1[i] * area * partial;
        s->heat[i] = per_mu * grid->q[i] * grid->weight[i] * s->mu[i] / macroscopic;
    }
}

/* Applies the map from `rise` to `next`. */
static void apply_map(flash_map *map)
{
    flash_scratch *s = map->s;
    const flash_grid *grid = map->grid;
    compute_moduli(map);
    compute_heat(map);
    const size_t rows = flash_padded_rows(grid->n), n_k = grid->n_k;
    double of_longest = 0;
    for (size_t i = 0; i < grid->n; i++)
        of_longest += s->heat[i] / grid->q[i];
    map->constant = map->longest * of_longest;
    memset(s->heat + grid->n, 0, (rows - grid->n) * sizeof *s->heat);
    memset(s->sum, 0, n_k * sizeof *s->sum);
    add_matrix_rows(grid->in, n_k, rows, n_k, s->heat, s->sum);
    for (size_t j = 0; j < n_k; j++)
        s->amount[j] = s->wave[j] * s->sum[j];
    for (size_t i = 0; i < grid->n; i++)
        s->next[i] = map->constant;
    add_matrix_rows(grid->out, grid->n, n_k, grid->n, s->amount, s->next);
    for (size_t i = 0; i < grid->n; i++)
        s->next[i] = fmin(s->next[i], map->law->hottest);
}

/* ---- Anderson mixing ------------------------------------------------------------------------- */

static double largest_magnitude(const double *x, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = x[i] > most || isnan(x[i]) ? x[i] : -x[i] > most ? -x[i] : most;
    return most;
}

WIDE_REGISTERS
static double dot_product(const double *a, const double *b, size_t n)
{
    wide sum = {0}, x, y;
    size_t i = 0;
    for (; i + WIDE <= n; i += WIDE) {
        simd_load(&x, a + i);
        simd_load(&y, b + i);
        sum += x * y;
    }
    double rest = simd_sum(&sum);
    for (; i < n; i++)
        rest += a[i] * b[i];
    return rest;
}

/* Computes the next temperatures: the combination of the last steps that minimises the residual
 * (Anderson mixing). */
static void mix_anderson(const flash_map *map, size_t n_steps, double step_share)
{
    flash_scratch *s = map->s;
    const size_t n = map->grid->n;
    double a[DEPTH * DEPTH], gamma[DEPTH] = {0};
    for (size_t u = 0; u < n_steps; u++) {
        gamma[u] = dot_product(s->changes + u * n, s->residual, n);
        for (size_t v = 0; v <= u; v++)
            a[u * DEPTH + v] = dot_product(s->changes + u * n, s->changes + v * n, n);
    }
    const bool mixed = n_steps > 0 && cholesky_solve(a, DEPTH, n_steps, min_pivot, gamma);
    memcpy(s->last_rise, s->rise, n * sizeof *s->rise);
    memcpy(s->last_residual, s->residual, n * sizeof *s->residual);
    for (size_t i = 0; i < n; i++) {
        double rise = s->rise[i], left = s->residual[i];
        for (size_t u = 0; mixed && u < n_steps; u++) {
            rise -= gamma[u] * s->steps[u * n + i];
            left -= gamma[u] * s->changes[u * n + i];
        }
        rise += step_share * left;
        s->rise[i] = fmin(fmax(rise, 0), map->law->hottest);
    }
}

/* Result of a search. */
typedef struct search_result {
    bool found;
    double residual; /* [K] */
    double gain;     /* ratio of the temperature error to the residual */
    size_t maps;
} search_result;

/* Iterates from `rise` until the residual is below the goal [K] or below the share `part` of the
 * rise. The first `n_damped` steps use the strong damping. */
static search_result iterate_to_fixed_point(flash_map *map, double goal, double part,
                                            size_t n_damped)
{
    flash_scratch *s = map->s;
    const size_t n = map->grid->n;
    search_result found = {.gain = 1};
    size_t n_steps = 0, slot = 0;
    while (found.maps < MAX_MAPS) {
        apply_map(map);
        found.maps++;
        for (size_t i = 0; i < n; i++)
            s->residual[i] = s->next[i] - s->rise[i];
        found.residual = largest_magnitude(s->residual, n);
        if (found.maps > 1) {
            double *step = s->steps + slot * n, *change = s->changes + slot * n;
            for (size_t i = 0; i < n; i++) {
                step[i] = s->rise[i] - s->last_rise[i];
                change[i] = s->residual[i] - s->last_residual[i];
            }
            found.gain =
                fmax(found.gain, largest_magnitude(step, n) / largest_magnitude(change, n));
            slot = (slot + 1) % DEPTH;
            n_steps += n_steps < DEPTH;
        }
        if (!isfinite(found.residual))
            return found;
        if (found.residual <= fmax(goal, part * largest_magnitude(s->next, n))) {
            found.found = s->next[n - 1] < map->law->hottest;
            return found;
        }
        if (found.maps < n_damped)
            mix_anderson(map, 0, strong_damping);
        else
            mix_anderson(map, n_steps,
                         n_steps > 0 && found.maps < FREE_MAPS && n_damped == 0 ? 1 : damping);
    }
    return found;
}

/* ---- a solution ------------------------------------------------------------------------------ */

/* Error of the rise from the lattice: a tenth of the bound of a trapezoidal rule whose integrand is
 * regular for |arg k| below pi/4, plus the waves below and above the lattice. */
static double lattice_error(const flash_grid *grid, double rise)
{
    return rise * (0.1 * exp(-0.5 * M_PI * M_PI / grid->step) + 4 * exp(-grid->below));
}

static double sum_weighted(const flash_grid *grid, const double *value)
{
    double sum = 0;
    for (size_t i = 0; i < grid->n; i++)
        sum += grid->weight[i] * value[i];
    return sum;
}

static double steepest_shift(const flash_law *law, double rise)
{
    const double step = 1e-3, at[] = {step, rise, rise + step}; /* [K] */
    double shift[3];
    flash_log_shift(law, at, 3, shift);
    return fmax(fabs(shift[0]), fabs(shift[2] - shift[1])) / step;
}

static double residual_goal(const flash_law *law)
{
    return goal_share * fmax(law->tolerance, 1e-13) / steepest_shift(law, 0);
}

static void set_uniform_rise(flash_scratch *s, const flash_grid *grid, double rise)
{
    for (size_t i = 0; i < grid->n; i++)
        s->rise[i] = rise;
}

/* If the full heat is too large for one search, it is increased in these steps. */
static const double first_part = 1.0 / 64, part_ratio = 2;

static search_result search_cold(flash_map *map)
{
    set_uniform_rise(map->s, map->grid, 0);
    search_result found = iterate_to_fixed_point(map, 0, first_tolerance, 0);
    if (found.found)
        return found;
    set_uniform_rise(map->s, map->grid, 0);
    for (map->part = first_part; map->part <= 1; map->part *= part_ratio) {
        found = iterate_to_fixed_point(map, 0, first_tolerance, 0);
        if (!found.found)
            break;
    }
    map->part = 1;
    return found;
}

/* Uniform rises [K] from which a contact is searched that has no cold solution. */
static const double probes[] = {160, 60, 20};

static search_result search_from_above(flash_map *map)
{
    search_result found = {0};
    for (size_t k = 0; !found.found && k < COUNT_OF(probes); k++) {
        set_uniform_rise(map->s, map->grid, fmin(probes[k], map->law->hottest));
        found = iterate_to_fixed_point(map, 0, first_tolerance, DAMPED_MAPS);
    }
    return found;
}

/* Finds a solution, then improves it with a fresh history of steps. */
flash_solution flash_solve(const wt_friction_workspace *ws, flash_scratch *s,
                           const friction_load *at)
{
    const flash_law *law = ws->flash;
    const flash_grid *grid = &law->grid;
    flash_map map = create_map(ws, s, at);
    search_result found = search_cold(&map);
    const size_t maps = found.maps;
    if (!found.found)
        found = search_from_above(&map);
    if (!found.found)
        return (flash_solution){.maps = maps};
    memcpy(s->rise, s->next, grid->n * sizeof *s->rise);
    found = iterate_to_fixed_point(&map, residual_goal(law), 0, 0);
    const heat_profile heat = {.law = law,
                               .square = grid->square,
                               .amount = s->amount,
                               .n = grid->n_k,
                               .constant = map.constant};
    double rise;
    heat_rise(&heat, &ws->roughness->q1, 1, &rise);
    return (flash_solution){.found = found.found,
                            .rise = rise,
                            .gain = found.gain,
                            .rise_error = found.gain * (found.residual + lattice_error(grid, rise)),
                            .hysteresis = sum_weighted(grid, s->mu),
                            .variance = sum_weighted(grid, s->g),
                            .steepest = steepest_shift(law, rise),
                            .maps = maps + found.maps,
                            .heat = heat};
}
