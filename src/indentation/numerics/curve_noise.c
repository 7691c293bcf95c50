/* Effect of the noise of a force curve on its fit.
 *
 * Forces are averaged in blocks, a few dozen over the contact. The cosine spectrum of the baseline
 * residual determines the spectrum of the noise. The candidate shapes (Whittle likelihood) are
 * white, white plus a power of the frequency, and white plus a first-order process. They are
 * averaged with their likelihoods, because the baseline has few of the slow waves that matter in
 * contact. The mean (of the standard deviations) gives the variance of sum_i J_i e_i along the
 * curve for any colour of the noise.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_model.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

enum {
    N = CURVE_N_PARAMETERS,
    IN_CONTACT = 32,          /* blocks */
    BLOCKS = 512,             /* largest total */
    BASELINE_BLOCKS = 192,    /* of the baseline, for its spectrum */
    MIN_BASELINE_BLOCKS = 16, /* smallest number in the baseline */
    WAVES = 64,               /* evaluated one by one; faster waves are combined */
    AT_ONCE = 16,             /* a multiple of WIDE */
    LANES = AT_ONCE / WIDE,
    PER_OCTAVE = 4, /* bands; within half a band the frequency changes by 9 % */
    POWERS = 4,     /* exponents of 1/f in halves, up to 2 for a random walk */
    CORNERS = 9,    /* octaves, up to the longest waves of 512 blocks */
    HEIGHTS = 5,    /* heights above the white part: octaves of the knee */
};

typedef struct block_sums {
    size_t n, length;                               /* number of blocks, samples per block */
    double e[BLOCKS], z[BLOCKS], column[N][BLOCKS]; /* means of residual and position, sums of J */
} block_sums;

/* Possible spectra of the noise, in bands of the frequency. */
enum { SHAPES = 82 };
static struct {
    double knee[SHAPES]; /* frequency below which the spectrum is not white */
    double inverse[SHAPES][NOISE_BANDS], logarithm[SHAPES][NOISE_BANDS],
        root[SHAPES][NOISE_BANDS]; /* of the density */
} shapes;

static void add_noise_shape(size_t s, double knee, double corner, double power)
{
    shapes.knee[s] = knee;
    for (size_t b = 0; b < NOISE_BANDS; b++) {
        const double f = exp2(-(double)b / PER_OCTAVE);
        const double density = 1.0 + pow(knee / sqrt(f * f + corner * corner), power);
        shapes.inverse[s][b] = 1.0 / density;
        shapes.logarithm[s][b] = log(density);
        shapes.root[s][b] = sqrt(density);
    }
}

static pthread_once_t shapes_once = PTHREAD_ONCE_INIT;

static void tabulate_shapes(void)
{
    size_t s = 0;
    add_noise_shape(s++, 0.0, 1.0, 1.0);
    for (int knee = -2; knee < CORNERS - 2; knee++)
        for (int power = 1; power <= POWERS; power++)
            add_noise_shape(s++, exp2(-knee), 0.0, 0.5 * power);
    for (int corner = 0; corner < CORNERS; corner++)
        for (int height = 0; height < HEIGHTS; height++)
            add_noise_shape(s++, exp2(height - corner), exp2(-corner), 2.0);
}

static size_t frequency_band(double frequency)
{
    const double band = -PER_OCTAVE * log2(frequency);
    return !(band > 0.0) ? 0 : band < NOISE_BANDS - 1 ? (size_t)(band + 0.5) : NOISE_BANDS - 1;
}

double curve_noise_variance(const curve_spectrum *s, double k, size_t n, size_t length)
{
    const double part = s->length / (double)length;
    return part * s->density[frequency_band(part * k / (double)n)];
}

/* Projects each of n_x series on the unit cosines k to k + AT_ONCE - 1 of n blocks. Several cosines
 * at once avoid the latency of the recursion. */
WIDE_REGISTERS static void project_cosines(size_t k, size_t n, const double (*x)[BLOCKS],
                                           size_t n_x, double along[AT_ONCE][N])
{
    wide twice[LANES], before[LANES], now[LANES], sums[N][LANES] = {{{0.0}}};
    double last[AT_ONCE], sum[N][AT_ONCE];
    const double mirror = k % 2 == 0 ? 1.0 : -1.0; /* sign of the second half of wave k */
    for (size_t j = 0; j < AT_ONCE; j++) {
        const double angle = M_PI * (double)(k + j) / (double)n, half = cos(0.5 * angle);
        twice[j / WIDE][j % WIDE] = 2.0 * (2.0 * half * half - 1.0);
        now[j / WIDE][j % WIDE] = half;
    }
    memcpy(before, now, sizeof now);
    for (size_t i = 0; i < n / 2; i++) {
        for (size_t c = 0; c < n_x; c++) {
            const double other = mirror * x[c][n - 1 - i], same = x[c][i] + other,
                         opposite = x[c][i] - other;
            const wide both = {same, opposite, same, opposite};
            for (size_t v = 0; v < LANES; v++)
                sums[c][v] += now[v] * both;
        }
        for (size_t v = 0; v < LANES; v++) {
            const wide next = twice[v] * now[v] - before[v];
            before[v] = now[v];
            now[v] = next;
        }
    }
    memcpy(last, now, sizeof last);
    memcpy(sum, sums, sizeof sum);
    for (size_t j = 0; j < AT_ONCE; j++) {
        const double scale = sqrt((k + j > 0 ? 2.0 : 1.0) / (double)n);
        for (size_t c = 0; c < n_x; c++) {
            if (n % 2 == 1 && (k + j) % 2 == 0)
                sum[c][j] += last[j] * x[c][n / 2];
            along[j][c] = scale * sum[c][j];
        }
    }
}

/* Subtracts the powers of z below `count` from the first n values of x. With count 3, z2 receives
 * the orthogonal square over `all` values. Returns the coefficient of the last power. */
WIDE_REGISTERS static double subtract_polynomial(const double *z, double *x, size_t n, size_t all,
                                                 int count, double *z2)
{
    double one[BASELINE_BLOCKS + BLOCKS],
        line[BASELINE_BLOCKS + BLOCKS], *const power[3] = {one, line, z2};
    const double middle = z[n / 2];
    double share = 0.0;
    for (int k = 0; k < count; k++) {
        double *now = power[k];
        for (size_t i = 0; i < all; i++)
            now[i] = 1.0;
        for (size_t i = 0; i < all && k > 0; i++)
            now[i] = (z[i] - middle) * power[k - 1][i];
        for (int d = 0; d < k; d++) {
            const double part = curve_dot(power[d], now, n) / curve_dot(power[d], power[d], n);
            for (size_t i = 0; i < all; i++)
                now[i] -= part * power[d][i];
        }
        const double norm = curve_dot(now, now, n);
        share = norm > 0.0 ? curve_dot(now, x, n) / norm : 0.0;
        for (size_t i = 0; i < n; i++)
            x[i] -= share * now[i];
    }
    return share;
}

WIDE_REGISTERS static void average_blocks(const curve_law *m, const double p[N], const double *e,
                                          size_t first, block_sums *b)
{
    const curve_samples *s = m->samples;
    const size_t contact = s->n - first, least = (s->n + BLOCKS - 1) / BLOCKS;
    b->length = contact / IN_CONTACT > least ? contact / IN_CONTACT : least;
    b->n = s->n / b->length;
    for (size_t c = 0; c < N; c++)
        memset(b->column[c], 0, b->n * sizeof b->column[c][0]);
    const size_t start = s->n - b->n * b->length;
    const size_t step = b->length < 4 ? 1 : b->length / 4; /* derivatives are smooth */
    const double length = (double)b->length, share = 1.0 / length;
    for (size_t i = 0; i < b->n; i++) {
        const size_t from = start + i * b->length, to = from + b->length;
        const double position = curve_sum(s->position + from, b->length);
        b->e[i] = curve_sum(e + from, b->length) * share;
        b->z[i] = position * share;
        if (to <= m->n_baseline) {
            b->column[CURVE_C][i] = m->free[CURVE_C] ? -p[CURVE_T] * length : 0.0;
            b->column[CURVE_F0][i] = length;
            b->column[CURVE_T][i] = m->free[CURVE_T] ? position - p[CURVE_C] * length : 0.0;
            continue;
        }
        size_t n_rows = 0;
        for (size_t j = from + step / 2; j < to; j += step, n_rows++) {
            double row[N];
            const double h = curve_model_row(m, p, j, row);
            for (size_t c = 0; c < N; c++)
                b->column[c][i] += row[c] * h;
        }
        for (size_t c = 0; c < N; c++)
            b->column[c][i] *= length / (double)n_rows;
    }
}

WIDE_REGISTERS
bool curve_noise_spectrum(const double *x, size_t n, curve_spectrum *to)
{
    double power[NOISE_BANDS] = {0.0}, count[NOISE_BANDS] = {0.0};
    double chance[SHAPES], level[SHAPES], best = -(double)INFINITY, all = 0.0;
    const double waves = (double)n - 2.0; /* x excludes an offset and a tilt */
    double *const density = to->density, rest = curve_dot(x, x, n);
    (void)pthread_once(&shapes_once, tabulate_shapes);
    for (size_t first = 0; first < n && first <= WAVES; first += AT_ONCE) {
        double along[AT_ONCE][N];
        project_cosines(first, n, (const double(*)[BLOCKS])x, 1, along);
        for (size_t k = first; k < first + AT_ONCE && k < n && k <= WAVES; k++) {
            const double square = along[k - first][0] * along[k - first][0];
            rest -= square;
            if (k < 2)
                continue;
            const size_t band = frequency_band((double)k / (double)n);
            power[band] += square;
            count[band] += 1.0;
        }
    }
    if (n > WAVES + 1) {
        const size_t band = frequency_band(sqrt(WAVES / (double)n));
        power[band] += fmax(rest, 0.0);
        count[band] += (double)(n - WAVES - 1);
    }
    size_t bands = NOISE_BANDS;
    while (bands > 0 && !(count[bands - 1] > 0.0))
        bands--;
    for (size_t s = 0; s < SHAPES; s++) {
        chance[s] = -(double)INFINITY;
        if (s > 0 && shapes.knee[s] < 8.0 / (double)n) /* not distinguishable from white noise */
            continue;
        const double logarithms = curve_dot(count, shapes.logarithm[s], bands),
                     sum = curve_dot(power, shapes.inverse[s], bands);
        if (!(sum > 0.0))
            return false;
        const int family = s == 0 ? 1 : 2 * CORNERS * (s <= POWERS * CORNERS ? POWERS : HEIGHTS);
        level[s] = sum / (waves - 2.0);
        chance[s] = -0.5 * (logarithms + waves * log(sum)) - log(family);
        best = fmax(best, chance[s]);
    }
    memset(density, 0, sizeof to->density);
    for (size_t s = 0; s < SHAPES; s++) {
        const double share = exp(chance[s] - best),
                     weight = share > 0.0 ? share * sqrt(level[s]) : 0.0;
        if (!(share > 0.0))
            continue;
        all += share;
        for (size_t b = 0; b < NOISE_BANDS; b++)
            density[b] += weight * shapes.root[s][b];
    }
    for (size_t b = 0; b < NOISE_BANDS; b++)
        density[b] *= density[b] / (all * all);
    return true;
}

/* Computes J' (covariance of the noise) J for the free parameters. */
WIDE_REGISTERS static void sum_noise_covariance(const block_sums *b, const curve_spectrum *s,
                                                size_t n_free, double to[N][N])
{
    double waves[AT_ONCE][N], left[N][N];
    size_t k = 0;
    for (size_t c = 0; c < n_free; c++)
        for (size_t d = 0; d <= c; d++) {
            left[c][d] = curve_dot(b->column[c], b->column[d], b->n);
            to[c][d] = 0.0;
        }
    for (; k < b->n && k <= WAVES; k++) {
        const double level = curve_noise_variance(s, k > 0 ? (double)k : 0.5, b->n, b->length);
        const double *along = waves[k % AT_ONCE];
        if (k % AT_ONCE == 0)
            project_cosines(k, b->n, (const double(*)[BLOCKS])b->column, n_free, waves);
        for (size_t c = 0; c < n_free; c++)
            for (size_t d = 0; d <= c; d++) {
                to[c][d] += level * along[c] * along[d];
                left[c][d] -= along[c] * along[d];
            }
    }
    if (k < b->n)
        for (size_t c = 0; c < n_free; c++)
            for (size_t d = 0; d <= c; d++)
                to[c][d] += curve_noise_variance(s, (double)k, b->n, b->length) * left[c][d];
}

/* Spectrum of the baseline residual without a line, or without a parabola if the baseline is bent.
 * The function also returns that parabola over all blocks. It returns false if the baseline is too
 * short. */
WIDE_REGISTERS static bool baseline_spectrum(const curve_law *m, const double *e, size_t first,
                                             block_sums *b, bool bent, double *baseline_parabola,
                                             double *curvature, curve_spectrum *to)
{
    double x[BLOCKS], y[BLOCKS], z[BASELINE_BLOCKS + BLOCKS], square[BASELINE_BLOCKS + BLOCKS];
    const size_t length = (first + BASELINE_BLOCKS - 1) / BASELINE_BLOCKS,
                 n = length > 0 ? first / length : 0;
    if (n < MIN_BASELINE_BLOCKS)
        return false;
    for (size_t i = 0; i < n; i++) {
        const size_t from = first - (n - i) * length;
        x[i] = curve_sum(e + from, length) / (double)length;
        z[i] = curve_sum(m->samples->position + from, length) / (double)length;
    }
    memcpy(z + n, b->z, b->n * sizeof *z);
    memcpy(y, x, n * sizeof *y);
    *curvature = subtract_polynomial(z, y, n, n + b->n, 3, square);
    for (size_t i = 0; i < b->n; i++)
        baseline_parabola[i] = bent ? *curvature * square[n + i] : 0.0;
    if (!bent)
        subtract_polynomial(z, x, n, n, 2, square);
    to->length = (double)length;
    return curve_noise_spectrum(bent ? y : x, n, to);
}

WIDE_REGISTERS curve_noise curve_estimate_noise(const curve_law *m, const double p[N],
                                                const double *e, size_t first, bool bent)
{
    block_sums b;
    curve_spectrum s;
    double baseline_parabola[BLOCKS] = {0.0};
    curve_noise noise = {.variance = 0.0, .correlation_length = 1.0, .curvature = (double)NAN};
    average_blocks(m, p, e, first, &b);
    if (first > 0)
        noise.variance = curve_dot(e, e, first) / (double)first;
    if (!baseline_spectrum(m, e, first, &b, bent, baseline_parabola, &noise.curvature, &s)) {
        s.length = (double)b.length;
        if (!curve_noise_spectrum(b.e, b.n, &s))
            return noise;
    }
    if (noise.variance >
        0.0) { /* at waves as long as the contact that the baseline also resolves */
        const double contact = (double)(m->samples->n - first);
        const double wave = fmax(2.0 / contact, 4.0 / (double)first);
        noise.correlation_length = fmax(1.0, curve_noise_variance(&s, wave, 1, 1) / noise.variance);
    }
    for (size_t c = 0; c < N; c++)
        noise.bend[c] = curve_dot(b.column[c], baseline_parabola, b.n);
    sum_noise_covariance(&b, &s, m->adhesive ? N : CURVE_W, noise.scatter);
    for (size_t c = 0; c < N; c++)
        for (size_t d = 0; d <= c; d++) {
            noise.scatter[c][d] += noise.bend[c] * noise.bend[d];
            noise.scatter[d][c] = noise.scatter[c][d];
        }
    return noise;
}
