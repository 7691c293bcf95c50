/* Friction of drawn scenes against friction_truth.h in quad precision, which is independent of the
 * kernel. It tests that the true error is within the stated one and within the tolerance, and
 * measures their ratio.
 *
 * kernel_checks [SCENES [SEED [TRUTHS [steep]]]]
 *
 * Each scene is computed at seven tolerances, with four numbers at each. TRUTHS is a file with the
 * true values of the seed, or "": existing values are read and new ones are added. "steep" gives
 * all scenes a material with the steepest permitted table. With CHECKS_LONG_DOUBLE the true values
 * are in long double, forty times faster. */
#ifndef CHECKS_LONG_DOUBLE
#define FRICTION_TRUTH_QUAD
#endif
#include "numeric/drawn_numbers.h"
#include "numeric/friction_truth.h"

#include "weartrack/friction.h"

#include <float.h>
#include <time.h>

/* ---- drawing --------------------------------------------------------------------------------- */

static size_t whole(size_t low, size_t high)
{
    return low + (size_t)uniform(0, (double)(high - low + 1));
}

enum { KNOTS = 64, POINTS = 6, TOLERANCES = 7, NUMBERS = 4 };

typedef struct drawn {
    scene s;
    double e[KNOTS], tau[KNOTS], loss[KNOTS], wavenumber[KNOTS], density[KNOTS];
    double strain[POINTS], f[POINTS], g[POINTS];
    double tolerance[TOLERANCES];
    size_t surface;
} drawn;

/* From the glassy to the rubbery state, as in rubbers. */
static void draw_prony(drawn *d)
{
    scene *s = &d->s;
    s->law = PRONY;
    s->n = whole(1, 16);
    s->e0 = decades(5, 7);
    const double slowest = decades(-3, 4), fastest = decades(-12, -5);
    for (size_t k = 0; k < s->n; k++) {
        const double part = s->n > 1 ? (double)k / (double)(s->n - 1) : 0;
        d->tau[k] = slowest * pow(fastest / slowest, part) * decades(-0.3, 0.3);
        d->e[k] = s->e0 * pow(10, 3 * part) * decades(-1, 1);
    }
}

static void draw_zener(drawn *d)
{
    d->s.law = ZENER;
    d->s.n = 1;
    d->s.alpha = uniform(0.2, 1);
    d->e[0] = decades(5, 7);
    d->e[1] = d->e[0] * decades(0.5, 4);
    d->tau[0] = decades(-10, 1);
}

/* A measured curve with noise; its knots may be steep or nearly coincide. */
static void draw_table(drawn *d)
{
    scene *s = &d->s;
    const double kind = uniform(0, 1);
    const bool steep = kind<0.3, close = kind> 0.8;
    s->law = TABLE;
    s->n = uniform(0, 1) < 0.9 ? whole(3, 9) : whole(10, 24);
    s->slope = !steep && !close && uniform(0, 1) < 0.3;
    double omega = decades(-2, 4), height = decades(5, 7);
    for (size_t k = 0; k < s->n; k++) {
        d->tau[k] = omega;
        d->e[k] = height;
        d->loss[k] = height * decades(-1.3, 0.3);
        const bool jump = steep && uniform(0, 1) < 0.3;
        omega *= jump                           ? decades(0.001, 0.1)
                 : close && uniform(0, 1) < 0.4 ? 1 + decades(-8, -1)
                                                : decades(0.1, 1);
        height *= jump ? decades(-1, 4) : decades(-0.05, 0.4);
    }
    s->slope = s->slope && d->e[1] > d->e[0] && d->loss[1] > d->loss[0];
}

/* Change of a logarithm, limited to a span. */
static double turn_back(double from, double by, double span)
{
    return fabs(from + by) < span ? by : fabs(from - by) < span ? -by : 0;
}

/* Lines between the knots with nearly the steepest permitted slopes, rising and falling, in a part
 * of the exponent range of a double. */
static void draw_steep_table(drawn *d)
{
    enum { STEEPEST = 99, SPAN = 140 };
    scene *s = &d->s;
    double log_omega = uniform(-4, 8), log_storage = uniform(5, 7), log_loss = uniform(4, 7);
    s->law = TABLE;
    s->n = whole(2, 24);
    for (size_t k = 0; k < s->n; k++) {
        d->tau[k] = pow(10, log_omega);
        d->e[k] = pow(10, log_storage);
        d->loss[k] = pow(10, log_loss);
        const double step = uniform(0, 1) < 0.5 ? decades(-3, -1) : decades(-1, 0.3);
        const double by_storage = uniform(-STEEPEST, STEEPEST) * step,
                     by_loss =
                         uniform(0, 1) < 0.5 ? by_storage : uniform(-STEEPEST, STEEPEST) * step;
        log_omega += step;
        log_storage += turn_back(log_storage, by_storage, SPAN);
        log_loss += turn_back(log_loss, by_loss, SPAN);
    }
}

/* ---- surfaces -------------------------------------------------------------------------------- */

static void add_knot(drawn *d, double factor_q, double factor_c)
{
    scene *s = &d->s;
    const size_t k = s->n_density++;
    d->wavenumber[k] = k > 0 ? d->wavenumber[k - 1] * factor_q : factor_q;
    d->density[k] = k > 0 ? d->density[k - 1] * factor_c : factor_c;
}

/* A power law of the wavenumber over a number of decades. */
static void add_power(drawn *d, double length, double exponent)
{
    add_knot(d, pow(10, length), pow(10, length * exponent));
}

static double affine(void)
{
    return -2 * (1 + uniform(0.5, 1));
}

static void draw_affine(drawn *d)
{
    scene *s = &d->s;
    s->q0 = decades(1, 4);
    s->q1 = s->q0 * decades(1, 6);
    s->qr = uniform(0, 1) < 0.3 ? s->q0 : s->q0 * pow(s->q1 / s->q0, uniform(0, 0.5));
    s->hurst = uniform(0.4, 1);
    s->c0 = decades(-18, -8) / pow(s->q0 / 500, 4);
}

static void begin_table(drawn *d)
{
    add_knot(d, decades(1, 4), decades(-18, -8));
}

/* Bands without waves, with edges of various steepness from 1 % of the wavenumber. */
static void draw_gaps(drawn *d)
{
    begin_table(d);
    const size_t gaps = whole(1, 4);
    for (size_t i = 0; i < gaps; i++) {
        const double fall = decades(-12, -1),
                     edge = uniform(0, 1) < 0.7 ? 0.00432 : uniform(0.0005, 0.05);
        add_power(d, uniform(0.1, 1.2), affine());
        add_knot(d, pow(10, edge), fall);
        add_power(d, uniform(0, 1) < 0.5 ? 0.00432 : uniform(0.05, 0.7), affine());
        add_knot(d, pow(10, edge), decades(-0.5, 0) / fall);
    }
    add_power(d, uniform(0.1, 1.5), affine());
}

/* Very low at the lowest wavenumbers, because the form was subtracted. */
static void draw_high_pass(drawn *d)
{
    begin_table(d);
    const double rise = uniform(2, 40);
    d->density[0] *= decades(-12, 0);
    add_power(d, fmin(uniform(0.05, 1.2), 16 / rise), rise);
    if (uniform(0, 1) < 0.5)
        add_power(d, uniform(0.1, 0.5), uniform(-1, 2));
    add_power(d, uniform(0.5, 4), affine());
}

/* Two or three instruments with different levels where they meet. */
static void draw_stitched(drawn *d)
{
    begin_table(d);
    const size_t parts = whole(2, 4);
    for (size_t i = 0; i < parts; i++) {
        const size_t knots = whole(1, 4);
        for (size_t k = 0; k < knots; k++)
            add_power(d, uniform(0.05, 0.6), affine() + uniform(-1, 1));
        if (i + 1 < parts)
            add_knot(d, 1 + decades(-4, -1), decades(-2, 2));
    }
}

/* Any exponent between two knots. */
static void draw_kinked(drawn *d)
{
    begin_table(d);
    const size_t knots = whole(2, 40);
    for (size_t k = 0; k < knots; k++)
        add_power(d, uniform(0, 1) < 0.3 ? uniform(0.002, 0.05) : uniform(0.05, 0.4),
                  uniform(0, 1) < 0.2 ? uniform(-60, 60) : uniform(-9, 4));
}

static const struct {
    const char *name;
    void (*draw)(drawn *d);
} surfaces[] = {{"affine road", draw_affine},
                {"band gaps", draw_gaps},
                {"high-passed", draw_high_pass},
                {"stitched", draw_stitched},
                {"kinked", draw_kinked}};
enum { SURFACES = sizeof surfaces / sizeof *surfaces };

/* Slopes that occur on surfaces. */
static void scale_surface(drawn *d)
{
    scene *s = &d->s;
    const double slope =
        (double)FN(sqrt)(2 * TRUTH_PI * slope_moment(s, FN(log)((real)s->q1 / s->q0)));
    const double scale = pow(decades(-2, 0.5) / slope, 2);
    s->c0 *= scale;
    for (size_t k = 0; k < s->n_density; k++)
        d->density[k] *= scale;
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static void draw_directions(scene *s)
{
    wt_transverse *t = &s->factors;
    s->transverse = true;
    *t = wt_transverse_defaults();
    t->axial_storage = t->axial_loss = decades(-0.3, 0.5);
    t->plane_poisson = uniform(0, 0.5);
    t->axial_poisson = uniform(0, 0.4);
}

static void draw_softening(drawn *d)
{
    scene *s = &d->s;
    s->n_strain = whole(2, POINTS);
    s->strain_factor = decades(-0.5, 0.5);
    double strain = (double)strain_at(s, FN(log)((real)s->q1 / s->q0)) * decades(-3, 0);
    for (size_t k = 0; k < s->n_strain; k++) {
        d->strain[k] = strain;
        d->f[k] = decades(-0.7, 0);
        d->g[k] = decades(-0.7, 0.2);
        strain *= decades(0.1, 1);
    }
}

static bool all_steep; /* All scenes have a steep table. */

static void draw_scene(drawn *d, size_t number)
{
    *d = (drawn){.s = {.e = d->e, .tau = d->tau, .loss = d->loss}};
    scene *s = &d->s;
    s->wavenumber = d->wavenumber;
    s->density = d->density;
    s->strain = d->strain;
    s->f = d->f;
    s->g = d->g;
    d->surface = number % SURFACES;
    const double law = uniform(0, 1);
    if (all_steep)
        draw_steep_table(d);
    else if (law < 0.2)
        draw_table(d);
    else if (law < 0.23)
        draw_zener(d);
    else
        draw_prony(d);
    s->nu = uniform(0, 1) < 0.5 ? 0.5 : uniform(0.3, 0.5);
    surfaces[d->surface].draw(d);
    if (s->n_density > 0) {
        s->q0 = s->wavenumber[0];
        s->q1 = s->wavenumber[s->n_density - 1];
    }
    if (uniform(0, 1) < 0.7)
        scale_surface(d);
    const double more = uniform(0, 1);
    if (more < 0.01)
        draw_directions(s);
    else if (more < 0.03)
        draw_softening(d);
    s->pressure = decades(3, 8);
    s->velocity = decades(-9, 2);
    s->gamma = uniform(0, 1) < 0.7 ? 1 : uniform(0, 1);
    if (uniform(0, 1) < 0.1) {
        s->thickness = decades(-3, 1) / s->q0;
        s->ratio = decades(-1.5, 1.5);
    }
    d->tolerance[0] = decades(-4, -2);
    d->tolerance[1] = decades(-8, -5);
    d->tolerance[2] = uniform(0, 1) < 0.5 ? 1e-10 : decades(-12, -9);
    for (size_t k = 3; k < TOLERANCES; k++)
        d->tolerance[k] = decades(-3 * (double)(k - 2), -3 * (double)(k - 3) - 1);
}

/* ---- true values ----------------------------------------------------------------------------- */

static FILE *truths;

#ifdef FRICTION_TRUTH_QUAD
static real text_to_real(const char *text)
{
    return strtoflt128(text, NULL);
}
static void real_to_text(real value, char *text, size_t room)
{
    quadmath_snprintf(text, room, "%.34Qg", value);
}
#else
static real text_to_real(const char *text)
{
    return strtold(text, NULL);
}
static void real_to_text(real value, char *text, size_t room)
{
    snprintf(text, room, "%.21Lg", value);
}
#endif

static truth truth_with_file(const scene *s, size_t number)
{
    char g[80], mu[80];
    size_t there;
    truth t;
    while (truths != NULL && fscanf(truths, "%zu %79s %79s", &there, g, mu) == 3)
        if (there == number)
            return (truth){text_to_real(g), text_to_real(mu)};
    t = truth_of(s);
    if (truths != NULL) {
        real_to_text(t.variance, g, sizeof g);
        real_to_text(t.hysteresis, mu, sizeof mu);
        fseek(truths, 0, SEEK_END);
        fprintf(truths, "%zu %s %s\n", number, g, mu);
        fflush(truths);
    }
    return t;
}

/* ---- checks ---------------------------------------------------------------------------------- */

typedef struct count {
    size_t checks, broken, runs, short_of, lied, n_quotients;
    double worst, worst_short, slowest;
    double *quotient; /* ratio of the stated to the true error */
} count;

static count counts[SURFACES];

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void check(count *c, const drawn *d, size_t number, size_t k, bool reached, const char *what,
                  wt_estimate actual, real exact)
{
    const scene *s = &d->s;
    const double error = (double)FN(fabs)(actual.value - exact), stated = actual.numerical_error;
    const double least = DBL_EPSILON / 2 * (double)FN(fabs)(exact) + DBL_MIN;
    c->checks++;
    c->quotient[c->n_quotients++] = stated / fmax(error, least);
    c->worst = fmax(c->worst, error / fmax(stated, least));
    const bool far =
        reached && what[0] != '1' && error > d->tolerance[k] * (double)FN(fabs)(exact) + least;
    c->lied += far;
    if (error <= stated + least && !far)
        return;
    c->broken += !(error <= stated + least);
    fprintf(stderr,
            "scene %zu (%s, %s%s%s%s, %zu terms, v %.2g, p %.2g, tolerance %.2g%s): %s %.17g is "
            "%.3g from "
            "the truth, %.3g is stated\n",
            number, surfaces[d->surface].name, s->n_strain > 0 ? "softened " : "",
            s->transverse ? "transverse " : "", s->thickness > 0 ? "layered " : "",
            s->law == PRONY   ? "prony"
            : s->law == TABLE ? "table"
                              : "zener",
            s->n, s->velocity, s->pressure, d->tolerance[k], reached ? "" : ", not reached", what,
            actual.value, error, stated);
}

/* Returns false if the scene is refused. */
static bool compute(const drawn *d, double tolerance, wt_friction_point *p)
{
    const scene *s = &d->s;
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    wt_friction_workspace *ws = NULL;
    wt_friction_options options = wt_friction_defaults();
    wt_error err = WT_ERROR_INIT;
    const wt_softening softening = scene_softening(s);
    options.tolerance = tolerance;
    options.gamma = s->gamma;
    if (softening.n > 0) {
        options.softening = &softening;
        options.strain_factor = s->strain_factor;
    }
    if (s->thickness > 0)
        options.layer = (wt_layer_state){.thickness = s->thickness, .modulus_ratio = s->ratio};
    wt_status status = scene_material(s, &material, &err);
    if (status == WT_OK)
        status = scene_roughness(s, &roughness, &err);
    if (status == WT_OK)
        status = wt_friction_workspace_new(material, roughness, &options, &ws, &err);
    if (status == WT_OK)
        status = wt_friction_compute(ws, s->pressure, &s->velocity, 1, p, &err);
    wt_friction_workspace_free(ws);
    wt_roughness_free(roughness);
    wt_material_free(material);
    if (status != WT_OK)
        fprintf(stderr, "%s\n", err.message);
    return status == WT_OK;
}

static void try_scene(size_t number)
{
    drawn d;
    draw_scene(&d, number);
    count *c = &counts[d.surface];
    truth exact = {0, 0};
    for (size_t k = 0; k < TOLERANCES; k++) {
        wt_friction_point p;
        const double start = seconds();
        if (!compute(&d, d.tolerance[k], &p))
            continue;
        c->slowest = fmax(c->slowest, seconds() - start);
        if (exact.variance == 0)
            exact = truth_with_file(&d.s, number);
        c->runs++;
        c->short_of += !p.meets_tolerance;
        if (!p.meets_tolerance)
            c->worst_short =
                fmax(c->worst_short, p.hysteresis.numerical_error / p.hysteresis.value);
        check(c, &d, number, k, p.meets_tolerance, "G", p.stress_variance, exact.variance);
        check(c, &d, number, k, p.meets_tolerance, "P", p.area_ratio, area(exact.variance));
        check(c, &d, number, k, p.meets_tolerance, "1 - P", p.one_minus_area,
              FN(erfc)(1 / (2 * FN(sqrt)(exact.variance))));
        check(c, &d, number, k, p.meets_tolerance, "mu", p.hysteresis, exact.hysteresis);
    }
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_row(const char *name, count *c)
{
    size_t above = 0;
    if (c->n_quotients == 0)
        return;
    qsort(c->quotient, c->n_quotients, sizeof *c->quotient, by_size);
    for (size_t i = 0; i < c->n_quotients; i++)
        above += c->quotient[i] > 1e4;
    printf("| %s | %zu | %zu | %.2g | %zu | %.1f %% | %.1g | %.3g | %.0f %% | %.0f ms |\n", name,
           c->checks, c->broken, c->worst, c->lied, 100 * (double)c->short_of / (double)c->runs,
           c->worst_short, c->quotient[c->n_quotients / 2],
           100 * (double)above / (double)c->n_quotients, 1e3 * c->slowest);
}

int main(int argc, char **argv)
{
    const size_t scenes = argc > 1 ? strtoul(argv[1], NULL, 10) : 20;
    const uint64_t seed = argc > 2 ? strtoul(argv[2], NULL, 10) : 1;
    all_steep = argc > 4 && strcmp(argv[4], "steep") == 0;
    if (argc > 3 && argv[3][0] != '\0')
        truths = fopen(argv[3], "a+");
    if (truths != NULL)
        rewind(truths);
    make_rule();
    count all = {0};
    const size_t capacity = scenes * TOLERANCES * NUMBERS;
    all.quotient = calloc(capacity, sizeof *all.quotient);
    for (size_t i = 0; i < SURFACES; i++)
        counts[i].quotient = calloc(capacity, sizeof *all.quotient);
    for (size_t i = 0; i < scenes; i++) {
        drawn_state = seed * 1000003 + i * 7919;
        try_scene(i);
    }
    printf(
        "| surface | checks | broken | worst error by stated | beyond its tolerance | short of it "
        "| worst | stated by true, median | above 1e4 | slowest "
        "|\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < SURFACES; i++) {
        count *c = &counts[i];
        memcpy(all.quotient + all.n_quotients, c->quotient, c->n_quotients * sizeof *c->quotient);
        all.n_quotients += c->n_quotients;
        all.checks += c->checks;
        all.broken += c->broken;
        all.runs += c->runs;
        all.short_of += c->short_of;
        all.lied += c->lied;
        all.worst = fmax(all.worst, c->worst);
        all.worst_short = fmax(all.worst_short, c->worst_short);
        all.slowest = fmax(all.slowest, c->slowest);
        print_row(surfaces[i].name, c);
    }
    print_row("all", &all);
    return all.broken > 0 || all.lied > 0;
}
