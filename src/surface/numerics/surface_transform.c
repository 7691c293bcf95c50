/* Computes a binned power spectrum of heights: window, discrete Fourier transform, means over
 * modes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include <fftw3.h>
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

/* A power law is nearly straight in a bin, and the first bins contain some modes. */
enum { PER_DECADE = 10 };

/* ---- windows --------------------------------------------------------------------------------- */

static double window_value(wt_surface_window window, size_t i, size_t n)
{
    const double t = (2 * (double)i + 1 - (double)n) / (double)n;
    switch (window) {
    case WT_WINDOW_HANN:
        return 0.5 * (1 - cos(2 * M_PI * (double)i / (double)n));
    case WT_WINDOW_WELCH:
        return 1 - t * t;
    case WT_WINDOW_NONE:
        break;
    }
    return 1;
}

/* Returns the correlation of modes under the window: mean(w^4) / mean(w^2)^2 over one direction,
 * for many points. */
static double window_correlation(wt_surface_window window)
{
    switch (window) {
    case WT_WINDOW_HANN:
        return 35.0 / 18;
    case WT_WINDOW_WELCH:
        return 10.0 / 7;
    case WT_WINDOW_NONE:
        break;
    }
    return 1;
}

/* Creates the window over one direction [n] and returns the mean of its square. The caller frees
 * it. */
static double *window_new(wt_surface_window window, size_t n, double *mean_square)
{
    double *w = wt_alloc(n, sizeof *w), sum = 0;
    for (size_t i = 0; i < n; i++) {
        w[i] = window_value(window, i, n);
        sum += w[i] * w[i];
    }
    *mean_square = sum / (double)n;
    return w;
}

/* ---- transforms ------------------------------------------------------------------------------ */

/* Rows of nx heights with space for nx / 2 + 1 complex numbers each. */
typedef struct transform {
    double *row; /* [ny * stride] */
    size_t nx, ny, stride;
    double density; /* factor on |amplitude|^2 */
} transform;

static pthread_mutex_t planning =
    PTHREAD_MUTEX_INITIALIZER; /* the FFTW planner is not thread-safe */

/* Transforms rows and columns, or each row separately. */
static wt_status execute_transform(const transform *t, bool lines, wt_error *err)
{
    fftw_complex *out = (fftw_complex *)t->row;
    const int nx = (int)t->nx, ny = (int)t->ny, stride = (int)t->stride;
    pthread_mutex_lock(&planning);
    fftw_plan plan = lines ? fftw_plan_many_dft_r2c(1, &nx, ny, t->row, NULL, 1, stride, out, NULL,
                                                    1, stride / 2, FFTW_ESTIMATE)
                           : fftw_plan_dft_r2c_2d(ny, nx, t->row, out, FFTW_ESTIMATE);
    pthread_mutex_unlock(&planning);
    if (plan == NULL)
        return wt_fail(err, WT_E_INTERNAL, "no Fourier transform of %zu x %zu heights", t->nx,
                       t->ny);
    fftw_execute(plan);
    pthread_mutex_lock(&planning);
    fftw_destroy_plan(plan);
    pthread_mutex_unlock(&planning);
    return WT_OK;
}

/* C = (dx dy)^2 |DFT(w h)|^2 / ((2 pi)^2 Lx Ly <w^2>), C1 = dx^2 |DFT(w h)|^2 / (2 pi L <w^2>). */
static wt_status windowed_transform(const wt_height_map *map, wt_surface_window window, bool lines,
                                    transform *t, wt_error *err)
{
    double square_x = 1, square_y = 1;
    double *wx = window_new(window, map->nx, &square_x);
    double *wy = window_new(lines ? WT_WINDOW_NONE : window, map->ny, &square_y);
    *t = (transform){.nx = map->nx, .ny = map->ny, .stride = 2 * (map->nx / 2 + 1)};
    t->row = wt_alloc(t->ny * t->stride, sizeof *t->row);
    for (size_t j = 0; j < t->ny; j++)
        for (size_t i = 0; i < t->nx; i++)
            t->row[j * t->stride + i] = wx[i] * wy[j] * map->z[j * t->nx + i];
    t->density = map->dx / (2 * M_PI * (double)map->nx * square_x);
    if (!lines)
        t->density *= map->dy / (2 * M_PI * (double)map->ny * square_y);
    free(wx);
    free(wy);
    return execute_transform(t, lines, err);
}

static double mode_density(const transform *t, size_t i, size_t j)
{
    const double *a = t->row + j * t->stride + 2 * i;
    return t->density * (a[0] * a[0] + a[1] * a[1]);
}

/* ---- bins ------------------------------------------------------------------------------------ */

typedef struct mode_sums {
    double n, q, ln_q, ln_q2, c, square; /* the last two relative to `first` */
    double first, cosine, sine, c_cosine, c_sine;
    double cosine_fourth, sine_fourth, c_cosine_fourth, c_sine_fourth;
    double sector_n[WT_SURFACE_SECTORS], sector_c[WT_SURFACE_SECTORS];
    double pairs; /* sum of squared correlations over pairs of modes; 0: not counted */
} mode_sums;

typedef struct binning {
    const surface_bins *limits;
    int first; /* index of the first bin */
    size_t n;
    mode_sums *sums;
} binning;

static int bin_index(const surface_bins *limits, double q)
{
    return (int)floor(PER_DECADE * log10(q / limits->reference) + 0.5);
}

static binning binning_new(const surface_bins *limits)
{
    binning b = {.limits = limits, .first = bin_index(limits, limits->low)};
    if (limits->high >= limits->low)
        b.n = (size_t)(bin_index(limits, limits->high) - b.first) + 1;
    b.sums = wt_alloc(b.n, sizeof *b.sums);
    return b;
}

/* Returns the bin of a mode, or -1 outside the limits. Modes of the lattice lie on the limits up
 * to rounding. */
static int mode_bin(const binning *b, double q)
{
    if (q < b->limits->low * (1 - 4 * DBL_EPSILON) || q > b->limits->high * (1 + 4 * DBL_EPSILON))
        return -1;
    const int k = bin_index(b->limits, q) - b->first;
    return k >= 0 && (size_t)k < b->n ? k : -1;
}

/* Adds the directional sums. The double angle of the direction has this cosine and sine. */
static void add_mode_direction(mode_sums *s, double cosine, double sine, double c,
                               double multiplicity)
{
    const double cosine_fourth = 2 * cosine * cosine - 1, sine_fourth = 2 * sine * cosine;
    const double sector = atan2(sine, cosine) / 2 * WT_SURFACE_SECTORS / M_PI;
    const size_t k = (size_t)(floor(sector + 0.5) + WT_SURFACE_SECTORS) % WT_SURFACE_SECTORS;
    s->cosine += multiplicity * cosine;
    s->sine += multiplicity * sine;
    s->c_cosine += multiplicity * c * cosine;
    s->c_sine += multiplicity * c * sine;
    s->cosine_fourth += multiplicity * cosine_fourth;
    s->sine_fourth += multiplicity * sine_fourth;
    s->c_cosine_fourth += multiplicity * c * cosine_fourth;
    s->c_sine_fourth += multiplicity * c * sine_fourth;
    s->sector_n[k] += multiplicity;
    s->sector_c[k] += multiplicity * c;
}

/* Adds a mode that represents one or two modes of the full plane. */
static void add_mode(const binning *b, double qx, double qy, double c, double multiplicity)
{
    const double q = hypot(qx, qy);
    const int k = mode_bin(b, q);
    if (k < 0)
        return;
    mode_sums *s = &b->sums[k];
    /* relative to the lower edge, which reduces cancellation */
    const double ln_q = log(q / b->limits->reference) - (k + b->first - 0.5) * M_LN10 / PER_DECADE;
    const double cosine = (qx * qx - qy * qy) / (q * q), sine = 2 * qx * qy / (q * q);
    if (s->n == 0)
        s->first = c;
    s->n += multiplicity;
    s->q += multiplicity * q;
    s->ln_q += multiplicity * ln_q;
    s->ln_q2 += multiplicity * ln_q * ln_q;
    s->c += multiplicity * (c - s->first);
    s->square += multiplicity * (c - s->first) * (c - s->first);
    add_mode_direction(s, cosine, sine, c, multiplicity);
}

/* ---- number of independent modes ------------------------------------------------------------- */

/* Correlation of the amplitudes of modes at distance 0, 1, 2 under a Hann window. */
static const double hann_neighbours[] = {1, 2.0 / 3, 1.0 / 6};
enum { REACH = sizeof hann_neighbours / sizeof *hann_neighbours - 1 };
/* In larger bins nearly all neighbours of a mode lie in the same bin. */
static const double few_modes = 20000;

static double squared_correlation(int apart)
{
    const double r = hann_neighbours[apart < 0 ? -apart : apart];
    return r * r;
}

/* Returns the number of modes of a sector at q for each independent one. It counts the
 * neighbours along q and those across within the width of the sector. */
static double sector_tie(const wt_height_map *map, wt_surface_window window, double q)
{
    const double along = window_correlation(window),
                 two = squared_correlation(1) + squared_correlation(2);
    const double step = 2 * M_PI / sqrt((double)map->nx * map->dx * (double)map->ny * map->dy);
    const double wide = q / step * M_PI / WT_SURFACE_SECTORS;
    const double within = (squared_correlation(1) * fmax(0, 1 - 1 / wide) +
                           squared_correlation(2) * fmax(0, 1 - 2 / wide)) /
                          two;
    return along * (1 + (along - 1) * within);
}

/* Bin indices of the modes from -reach to reach in both directions, row by row. */
typedef struct mode_grid {
    int reach_x, reach_y;
    short *bin;
} mode_grid;

static int grid_bin(const mode_grid *g, int i, int j)
{
    if (abs(i) > g->reach_x || abs(j) > g->reach_y)
        return -1;
    return g
        ->bin[(size_t)(j + g->reach_y) * (size_t)(2 * g->reach_x + 1) + (size_t)(i + g->reach_x)];
}

static double mode_pair_sum(const mode_grid *g, int i, int j, int bin, int reach_y)
{
    double sum = 0;
    for (int v = -reach_y; v <= reach_y; v++)
        for (int u = -REACH; u <= REACH; u++)
            if (grid_bin(g, i + u, j + v) == bin)
                sum += squared_correlation(u) * squared_correlation(v);
    return sum;
}

/* First mode of a row of the transform. In a map of levelled rows the mode 0 has lost its heights,
 * and a window mixes it with its neighbour. */
static size_t first_mode(const wt_height_map *map, wt_surface_window window, size_t j)
{
    if (map->levelled)
        return window == WT_WINDOW_NONE ? 1 : 2;
    return j == 0 ? 1 : 0;
}

/* Counts the pairs in bins of few modes, whose neighbours are often in other bins. */
static void count_correlated_pairs(const wt_height_map *map, bool lines, const binning *b)
{
    double most = 0;
    for (size_t k = 0; k < b->n; k++)
        if (b->sums[k].n > 0 && b->sums[k].n <= few_modes)
            most = b->limits->reference * pow(10, (b->first + (int)k + 0.5) / PER_DECADE);
    const double step_x = 2 * M_PI / ((double)map->nx * map->dx),
                 step_y = lines ? 1 : 2 * M_PI / ((double)map->ny * map->dy);
    mode_grid g = {.reach_x = (int)fmin(most / step_x, (double)map->nx / 2),
                   .reach_y = lines ? 0 : (int)fmin(most / step_y, (double)map->ny / 2)};
    const size_t columns = (size_t)(2 * g.reach_x + 1), rows = (size_t)(2 * g.reach_y + 1);
    g.bin = wt_alloc(columns * rows, sizeof *g.bin);
    for (size_t n = 0; n < columns * rows; n++) {
        const int i = (int)(n % columns) - g.reach_x, j = (int)(n / columns) - g.reach_y;
        const bool is_left_out =
            map->levelled && (size_t)abs(i) < first_mode(map, WT_WINDOW_HANN, 1);
        g.bin[n] = is_left_out ? -1 : (short)mode_bin(b, hypot(step_x * i, step_y * j));
    }
    for (size_t n = 0; n < columns * rows; n++) {
        const int i = (int)(n % columns) - g.reach_x, j = (int)(n / columns) - g.reach_y;
        if (g.bin[n] >= 0 && b->sums[g.bin[n]].n <= few_modes)
            b->sums[g.bin[n]].pairs += mode_pair_sum(&g, i, j, g.bin[n], lines ? 0 : REACH);
    }
    free(g.bin);
}

/* ---- means ----------------------------------------------------------------------------------- */

/* Returns the degrees of freedom of a mean of modes: two for each independent mode. -q is not
 * independent of q. */
static double mean_freedom(const mode_sums *s, size_t n_lines, double correlation)
{
    /* the lines count as one, and the pairs were counted for one line */
    return s->pairs > 0
               ? (double)n_lines * (s->n / (double)n_lines) * (s->n / (double)n_lines) / s->pairs
               : s->n / correlation;
}

static wt_spectrum_bin finish_bin(const mode_sums *s, int index, double reference, double freedom,
                                  double correlation)
{
    const double edge = reference * pow(10, (index - 0.5) / PER_DECADE);
    const double c = s->first + s->c / s->n;
    const double squares = s->square - s->c * s->c / s->n;
    wt_spectrum_bin bin = {.index = index,
                           .wavenumber = edge * exp(s->ln_q / s->n),
                           .width = sqrt(fmax(0, s->ln_q2 - s->ln_q * s->ln_q / s->n) / s->n),
                           .mean_wavenumber = s->q / s->n,
                           .density = c,
                           .deviation = sqrt(fmax(0, squares) / (s->n - 1)),
                           .n = (size_t)s->n,
                           .freedom = freedom,
                           .shared_freedom = s->n / correlation,
                           .cosine = 2 * (s->c_cosine - c * s->cosine) / (s->n * c),
                           .sine = 2 * (s->c_sine - c * s->sine) / (s->n * c),
                           .cosine_fourth =
                               2 * (s->c_cosine_fourth - c * s->cosine_fourth) / (s->n * c),
                           .sine_fourth = 2 * (s->c_sine_fourth - c * s->sine_fourth) / (s->n * c)};
    for (size_t k = 0; k < WT_SURFACE_SECTORS; k++) {
        bin.sector_modes[k] = s->sector_n[k];
        bin.sector_sum[k] = s->sector_c[k] / c;
    }
    return bin;
}

/* Returns the multiplicity of a mode. With an even number of points the mode n/2 occurs once, as
 * mode 0 does. */
static double mode_multiplicity(size_t i, size_t n)
{
    return i == 0 || 2 * i == n ? 1 : 2;
}

static void bin_plane(const transform *t, const wt_height_map *map, wt_surface_window window,
                      const binning *b)
{
    const double step_x = 2 * M_PI / ((double)t->nx * map->dx),
                 step_y = 2 * M_PI / ((double)t->ny * map->dy);
    for (size_t j = 0; j < t->ny; j++) {
        const double qy = step_y * (2 * j < t->ny ? (double)j : (double)j - (double)t->ny);
        for (size_t i = first_mode(map, window, j); i <= t->nx / 2; i++)
            add_mode(b, step_x * (double)i, qy, mode_density(t, i, j), mode_multiplicity(i, t->nx));
    }
}

/* Bins the modes of lines. Each mode also represents that at -q. */
static void bin_lines(const transform *t, const wt_height_map *map, const binning *b)
{
    const double step = 2 * M_PI / ((double)t->nx * map->dx);
    for (size_t j = 0; j < t->ny; j++)
        for (size_t i = 1; i <= t->nx / 2; i++)
            add_mode(b, step * (double)i, 0, mode_density(t, i, j), mode_multiplicity(i, t->nx));
}

wt_status surface_transform(const wt_height_map *map, wt_surface_window window, bool lines,
                            const surface_bins *bins, wt_surface_spectrum *to, wt_error *err)
{
    transform t = {.row = NULL};
    const binning b = binning_new(bins);
    const double one = window_correlation(window), correlation = lines ? one : one * one;
    const wt_status status = windowed_transform(map, window, lines, &t, err);
    to->kind = lines ? WT_SPECTRUM_1D : WT_SPECTRUM_2D;
    to->n = 0;
    if (status == WT_OK) {
        to->bins = wt_alloc(b.n, sizeof *to->bins);
        if (lines)
            bin_lines(&t, map, &b);
        else
            bin_plane(&t, map, window, &b);
        if (window == WT_WINDOW_HANN)
            count_correlated_pairs(map, lines, &b);
        for (size_t k = 0; k < b.n; k++) {
            if (!(b.sums[k].n > 1))
                continue;
            wt_spectrum_bin *bin = &to->bins[to->n++];
            *bin =
                finish_bin(&b.sums[k], b.first + (int)k, bins->reference,
                           mean_freedom(&b.sums[k], lines ? map->ny : 1, correlation), correlation);
            bin->sector_tie = sector_tie(map, window, bin->wavenumber);
        }
    }
    free(t.row);
    free(b.sums);
    return status;
}
