/* The modified layer against numeric cases, and required relations of formation and wear. */
#include "assert_near.h"

#include "friction/numerics/persson_contact.h"
#include "layer/numerics/energy_density_kernel.h"
#include "numeric/cases.h"
#include "weartrack/layer.h"

#include <float.h>
#include <gsl/gsl_integration.h>
#include <time.h>

typedef struct rig {
    wt_energy_source source;
    wt_layer_parameters parameters;
} rig;

static double *copy_numbers(const double *values, size_t n)
{
    double *copy = malloc(n * sizeof *copy);
    assert_non_null(copy);
    memcpy(copy, values, n * sizeof *copy);
    return copy;
}

static rig rig_make(const double *q, const double *power, size_t n)
{
    rig r = {.source = {.profile = WT_PROFILE_PERSSON,
                        .n = n,
                        .wavenumber = copy_numbers(q, n),
                        .power = copy_numbers(power, n)},
             .parameters = wt_layer_defaults()};
    r.parameters.critical_energy = 2e10;
    r.parameters.specific_wear_rate = 1e-12;
    r.parameters.pressure = 4e5;
    r.parameters.velocity = 5e-3;
    return r;
}

/* Case B of the numeric cases. */
static rig rig_mild(void)
{
    return rig_make((double[]){1e6}, (double[]){400}, 1);
}

static rig rig_several(void)
{
    return rig_make((double[]){3e4, 4.1e5, 6e6}, (double[]){120, 90, 200}, 3);
}

static rig rig_case(const numeric_case *c)
{
    const case_line *q = case_find(c, false, "wavenumber");
    const case_line *power = case_find(c, false, "power");
    assert_non_null(q);
    assert_non_null(power);
    rig r = rig_make(q->value, power->value, q->n);
    if (strcmp(case_word(c, false, "profile"), "incompressible") == 0)
        r.source.profile = WT_PROFILE_INCOMPRESSIBLE;
    r.source.local_friction = case_number(c, false, "local_friction", 0);
    wt_layer_parameters *p = &r.parameters;
    p->critical_energy = case_number(c, false, "critical_energy", (double)NAN);
    p->damage = case_number(c, false, "damage", 1);
    p->specific_wear_rate = case_number(c, false, "specific_wear_rate", 0);
    p->pressure = case_number(c, false, "pressure", (double)NAN);
    p->velocity = case_number(c, false, "velocity", (double)NAN);
    p->start_thickness = case_number(c, false, "start_thickness", 0);
    return r;
}

static void rig_free(rig *r)
{
    wt_energy_source_clear(&r->source);
}

static wt_layer_steady_state balance_of(const rig *r)
{
    wt_layer_steady_state b;
    wt_error err = WT_ERROR_INIT;
    if (wt_layer_steady_state_compute(&r->source, &r->parameters, &b, &err) != WT_OK)
        fail_msg("balance: %s", err.message);
    return b;
}

static wt_layer_point point_at(const rig *r, double time)
{
    wt_layer_point p;
    wt_error err = WT_ERROR_INIT;
    if (wt_layer_history(&r->source, &r->parameters, &time, 1, &p, &err) != WT_OK)
        fail_msg("history: %s", err.message);
    return p;
}

/* ---- numeric cases --------------------------------------------------------------------------- */

static void check_bound(const char *name, const char *what, wt_estimate actual, double expected)
{
    /* closed-form references have an error of 1e-15, and are 0 where the truth is below 1e-15 m */
    const double slack = 1e-14 * fabs(expected) + (expected == 0 ? 1e-15 : 0);
    if (!(fabs(actual.value - expected) <= actual.numerical_error + slack))
        fail_msg("%s: %s %.17g is %.3g from %.17g, but %.3g is stated", name, what, actual.value,
                 fabs(actual.value - expected), expected, actual.numerical_error);
}

static void check_thickness(const char *name, const char *what, wt_estimate actual, double expected)
{
    if (fabs(actual.value - expected) > 1e-12 * expected + (expected == 0 ? 1e-15 : 0))
        fail_msg("%s: %s %.17g is not %.17g", name, what, actual.value, expected);
    check_bound(name, what, actual, expected);
    assert_true(actual.value >= 0);
    assert_true(actual.numerical_error <= 1e-10 * actual.value + 1e-18);
}

static void check_balance(const numeric_case *c, const rig *r, const case_line *line)
{
    const wt_layer_steady_state b = balance_of(r);
    const double expected = line->value[0];
    rig worn = *r;
    worn.parameters.incubation = true;
    if (strcmp(line->key, "thickness") == 0)
        check_thickness(c->name, line->key, b.thickness, expected);
    else if (strcmp(line->key, "surface_power") == 0)
        assert_near(b.surface_power, expected, 1e-14);
    else if (strcmp(line->key, "formation_rate_zero") == 0)
        assert_near(b.formation_rate_zero, expected, 1e-14);
    else if (strcmp(line->key, "wear_rate") == 0)
        assert_near(b.wear_rate, expected, 1e-14);
    else if (strcmp(line->key, "ratio") == 0)
        assert_near(b.ratio, expected, 1e-14);
    else if (strcmp(line->key, "relaxation_time") == 0)
        assert_near(b.relaxation_time.value, expected, 1e-12);
    else if (strcmp(line->key, "critical_specific_wear_rate") == 0)
        assert_near(b.critical_specific_wear_rate, expected, 1e-12);
    else if (strcmp(line->key, "eigenvalue") == 0)
        assert_near(b.eigenvalue, expected, 1e-12);
    else if (strcmp(line->key, "incubation_time") == 0)
        assert_near(b.incubation_time.value, expected, 1e-12);
    else if (strcmp(line->key, "incubation_time_with_wear") == 0)
        assert_near(balance_of(&worn).incubation_time.value, expected, 1e-12);
    else if (strcmp(line->key, "removal_time") == 0)
        assert_near(b.removal_time.value, expected, 1e-12);
    else if (strcmp(line->key, "layer_exists") == 0)
        assert_int_equal(b.regime != WT_LAYER_NONE, expected);
    else if (strcmp(line->key, "surface_density") == 0)
        assert_near(wt_energy_density(&r->source, 0), expected, 1e-14);
    else if (strcmp(line->key, "surface_rate") == 0)
        assert_near(wt_energy_density(&r->source, 0) / r->parameters.critical_energy, expected,
                    1e-14);
    else
        fail_msg("%s: no quantity %s", c->name, line->key);
}

static bool check_naive(const rig *r, double time, double expected)
{
    rig unworn = *r;
    unworn.parameters.specific_wear_rate = 0;
    unworn.parameters.incubation = true;
    const double formed = point_at(&unworn, time).thickness.value;
    assert_near(fmax(0, formed - balance_of(r).wear_rate * time), expected, 1e-12);
    return true;
}

/* Returns true if the line belongs to a history. */
static bool check_history(const numeric_case *c, rig *r, const case_line *line)
{
    const bool history = strcmp(line->key, "history") == 0;
    const bool damage = strcmp(line->key, "damage") == 0;
    const bool formation = strcmp(line->key, "formation") == 0;
    if (strcmp(line->key, "naive") == 0)
        return check_naive(r, line->value[0], line->value[1]);
    if (!history && !damage && !formation)
        return false;
    r->parameters.incubation = !history;
    const wt_layer_point p = point_at(r, line->value[0]);
    r->parameters.incubation = false;
    if (formation)
        assert_near(p.formation_rate, line->value[1], 1e-12);
    else
        check_thickness(c->name, line->key, p.thickness, line->value[1]);
    assert_near(p.wear_rate,
                r->parameters.specific_wear_rate * r->parameters.pressure * r->parameters.velocity,
                1e-15);
    return true;
}

static void check_exponential(const case_line *line)
{
    const double *v = line->value;
    const double delta = wt_layer_exponential_thickness(v[0], v[1], v[2], v[3], v[4]);
    assert_near(delta, v[5], 1e-12);
}

/* Qf / Qf(0) of j ~ q^(1 - 2 H) between q0 and q1; the source has Gauss nodes in ln q. */
static void check_tail_ratio(const numeric_case *c, const case_line *line)
{
    enum { PANELS = 40, NODES = 20, TERMS = PANELS * NODES };
    const double q0 = case_number(c, false, "q0", 0), q1 = case_number(c, false, "q1", 0);
    const double width = log(q1 / q0) / PANELS;
    double q[TERMS], power[TERMS];
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(NODES);
    assert_non_null(rule);
    for (size_t i = 0; i < TERMS; i++) {
        const size_t panel = i / NODES;
        double at, weight;
        gsl_integration_glfixed_point(width * (double)panel, width * (double)(panel + 1), i % NODES,
                                      &at, &weight, rule);
        q[i] = q0 * exp(at);
        power[i] = weight * exp((2 - 2 * line->value[0]) * at);
    }
    gsl_integration_glfixed_table_free(rule);
    rig r = rig_make(q, power, TERMS);
    assert_near(wt_energy_tail(&r.source, line->value[1]) / wt_energy_tail(&r.source, 0),
                line->value[2], 1e-12);
    rig_free(&r);
}

/* E_layer / E_eff and E_eff / E_layer. */
static void check_layered(const case_line *line)
{
    const double stiffness = line->value[0] * layered_scale(line->value[1], 1 / line->value[0]);
    assert_near(1 / stiffness, line->value[2], 1e-12);
    assert_near(stiffness, line->value[3], 1e-12);
}

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/layer.txt", "r");
    assert_non_null(in);
    numeric_case *c = malloc(sizeof *c);
    assert_non_null(c);
    size_t lines = 0;
    while (case_read(in, c)) {
        if (strcmp(c->name, "Q_step_in_severity") == 0)
            continue; /* has its own test */
        const bool layer = case_find(c, false, "critical_energy") != NULL;
        const clock_t start = clock();
        rig r = layer ? rig_case(c) : rig_mild();
        for (size_t i = 0; i < c->n; i++) {
            const case_line *line = &c->lines[i];
            if (!line->expected)
                continue;
            lines++;
            if (strcmp(line->key, "exponential") == 0)
                check_exponential(line);
            else if (strcmp(line->key, "tail_ratio") == 0)
                check_tail_ratio(c, line);
            else if (strcmp(line->key, "layered") == 0)
                check_layered(line);
            else if (!check_history(c, &r, line))
                check_balance(c, &r, line);
        }
        rig_free(&r);
        assert_true(clock() - start < CLOCKS_PER_SEC);
    }
    assert_int_equal(lines, 190);
    free(c);
    fclose(in);
}

/* Two stages at constant load: the second starts where the first ended. */
static void step_in_severity(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/layer.txt", "r");
    assert_non_null(in);
    numeric_case *c = malloc(sizeof *c);
    assert_non_null(c);
    bool found = false;
    while (!found && case_read(in, c))
        found = strcmp(c->name, "Q_step_in_severity") == 0;
    fclose(in);
    assert_true(found);
    rig r = rig_mild();
    const wt_layer_point last = point_at(&r, 1000);
    const double end = last.thickness.value;
    assert_near(end, case_number(c, true, "end_of_stage_1", 0), 1e-12);
    assert_near(last.wear_rate * 1000, case_number(c, true, "worn_in_stage_1", 0), 1e-12);
    r.source.power[0] = 72000;
    r.parameters.pressure = 1.2e6;
    r.parameters.velocity = 0.3;
    r.parameters.specific_wear_rate = 2e-11;
    r.parameters.start_thickness = end;
    assert_near(balance_of(&r).removal_time.value, case_number(c, true, "removal_time", 0), 1e-12);
    for (size_t i = 0; i < c->n; i++)
        if (strcmp(c->lines[i].key, "history") == 0)
            assert_near(point_at(&r, c->lines[i].value[0]).thickness.value, c->lines[i].value[1],
                        1e-12);
    rig_free(&r);
    free(c);
}

/* A profile with a peak at z = 1/q begins there: e^2 U_c Lambda / (4 q J0). */
static void buried_band(void **state)
{
    (void)state;
    rig r = rig_mild();
    r.source.profile = WT_PROFILE_INCOMPRESSIBLE;
    r.parameters.specific_wear_rate = 0;
    const double onset = exp(2) * 2e10 / (4 * 1e6 * 400);
    assert_near(balance_of(&r).incubation_time.value, onset, 1e-12);
    r.parameters.incubation = true;
    assert_near(point_at(&r, onset * (1 - 1e-9)).thickness.value, 0, 0);
    const wt_estimate first = point_at(&r, onset * (1 + 1e-9)).thickness;
    assert_near(first.value, 1e-6, 1e-3);
    r.parameters.specific_wear_rate = 1e-12; /* wear carries the band upwards: it starts later */
    assert_true(balance_of(&r).incubation_time.value > onset);
    rig_free(&r);
}

/* Two distant waves, no wear. The long one alone determines the deep band, x = q z near 1: there 2
 * ln x - 2 x + 2 is minus the logarithm of the time over its onset. */
static void deep_band_from_its_onset(void **state)
{
    (void)state;
    const double far_apart[] = {1.3e7, 1e8};
    for (size_t i = 0; i < 2; i++)
        for (double late = 0.1; late > 1e-12; late *= 0.37) {
            rig r = rig_make((double[]){1e4, far_apart[i]}, (double[]){3, 400}, 2);
            r.source.profile = WT_PROFILE_INCOMPRESSIBLE;
            r.parameters.incubation = true;
            r.parameters.specific_wear_rate = 0;
            const double onset = exp(2) * 2e10 / (4 * 1e4 * 3);
            const wt_estimate before = point_at(&r, onset * (1 - late)).thickness;
            assert_true(before.value < 2e-6);
            const wt_estimate deep = point_at(&r, onset * (1 + late)).thickness;
            const double x = 1e4 * deep.value;
            assert_true(x > 1 && x < 1.5);
            /* at the onset x follows the square root of the time */
            const double slope = 2 - 2 / x;
            assert_near_abs(2 * log1p(x - 1) - 2 * (x - 1), -log1p(late),
                            1e4 * slope * deep.numerical_error + 1e-15);
            assert_true(deep.numerical_error < 1e-4 * 1e-6 / sqrt(late));
            rig_free(&r);
        }
}

/* Within rounding of the onset the band may exist or not: the error states it. */
static void error_at_the_onset(void **state)
{
    (void)state;
    rig r = rig_make((double[]){1e4, 1e8}, (double[]){3, 400}, 2);
    r.source.profile = WT_PROFILE_INCOMPRESSIBLE;
    r.parameters.incubation = true;
    r.parameters.specific_wear_rate = 0;
    r.source.numerical_error = 1e-6;
    const double onset = exp(2) * 2e10 / (4 * 1e4 * 3);
    for (int late = -1; late <= 1; late += 2) {
        const wt_estimate near = point_at(&r, onset * (1 + 5e-7 * late)).thickness;
        assert_true(fabs(near.value - 1e-4) <= near.numerical_error);
        assert_true(near.value - near.numerical_error <= 1e-6);
    }
    rig_free(&r);
}

/* Every band of three waves with wear, against a scan of D in long double that is finer than any of
 * them. */
static long double gain_of(const rig *r, long double z, long double way)
{
    long double sum = 0;
    for (size_t i = 0; i < r->source.n; i++) {
        const long double q = r->source.wavenumber[i];
        const long double a = q * z, b = q * (z + way);
        sum += r->source.power[i] *
               (expl(-2 * a) * (1 + 2 * a + 2 * a * a) - expl(-2 * b) * (1 + 2 * b + 2 * b * b));
    }
    return sum;
}

static void bands_with_wear(void **state)
{
    (void)state;
    rig r = rig_make((double[]){1e4, 2e5, 1.1e7}, (double[]){3, 8, 400}, 3);
    r.source.profile = WT_PROFILE_INCOMPRESSIBLE;
    r.parameters.incubation = true;
    r.parameters.specific_wear_rate = 1e-14;
    const long double wear = 1e-14L * 4e5L * 5e-3L, level = 2e10L * wear;
    double last = 0;
    for (double time = 10; time < 1e7; time *= 1.21) {
        const wt_estimate p = point_at(&r, time).thickness;
        const long double way = wear * time;
        assert_true(p.value >= last);
        last = p.value;
        if (p.value > 0)
            assert_true(fabsl(gain_of(&r, p.value, way) / level - 1) < 1e-9L);
        for (long double z = 1.0001L * p.value + 1e-10L; z < 4e-3L; z *= 1.0003L)
            assert_true(gain_of(&r, z, way) < level);
    }
    assert_true(last > 1e-4);
    rig_free(&r);
}

/* Time to a share of the steady state: closed forms for one wave, and the inverse of the
 * history. */
static void time_to_a_thickness(void **state)
{
    (void)state;
    const double share = 0.9;
    rig one = rig_mild(), repeated = rig_several();
    const wt_layer_steady_state b = balance_of(&one);
    const double settle = 1 / (2e6 * b.wear_rate), power = pow(b.ratio, share - 1);
    for (int incubation = 0; incubation < 2; incubation++) {
        one.parameters.incubation = repeated.parameters.incubation = incubation;
        wt_estimate goal = b.thickness, time;
        goal.value *= share;
        assert_int_equal(wt_layer_growth_time(&one.source, &one.parameters, goal, &time, NULL),
                         WT_OK);
        const double exact =
            incubation ? -settle * log1p(-power) : settle * (log1p(-1 / b.ratio) - log1p(-power));
        assert_near(time.value, exact, 1e-12);
        assert_near_abs(time.value, exact, time.numerical_error);
        assert_true(time.numerical_error < 1e-11 * time.value);
        for (int profile = 0; profile < 2; profile++) {
            repeated.source.profile = profile ? WT_PROFILE_INCOMPRESSIBLE : WT_PROFILE_PERSSON;
            goal = balance_of(&repeated).thickness;
            goal.value *= share;
            assert_int_equal(
                wt_layer_growth_time(&repeated.source, &repeated.parameters, goal, &time, NULL),
                WT_OK);
            assert_near(point_at(&repeated, time.value).thickness.value, goal.value, 1e-9);
            goal.numerical_error = 0.01 * goal.value; /* its uncertainty is propagated */
            assert_int_equal(
                wt_layer_growth_time(&repeated.source, &repeated.parameters, goal, &time, NULL),
                WT_OK);
            assert_true(time.numerical_error > 0.01 * time.value);
        }
        goal.value = 2 * b.thickness.value;
        assert_int_equal(wt_layer_growth_time(&one.source, &one.parameters, goal, &time, NULL),
                         WT_OK);
        assert_true(isnan(time.value));
    }
    rig_free(&one);
    rig_free(&repeated);
}

/* ---- laws ------------------------------------------------------------------------------------ */

static void three_methods_agree(void **state)
{
    (void)state;
    /* a sum of two equal exponentials is one, but uses the general method */
    rig one = rig_mild();
    rig two = rig_make((double[]){1e6, 1e6 * (1 + 1e-15)}, (double[]){150, 250}, 2);
    for (double time = 1e-9; time < 1e7; time *= 7.3) {
        for (double start = 0; start < 1e-4; start = start * 9.1 + 1e-9) {
            one.parameters.start_thickness = two.parameters.start_thickness = start;
            const wt_layer_point a = point_at(&one, time);
            const wt_layer_point b = point_at(&two, time);
            assert_near_abs(b.thickness.value, a.thickness.value,
                            a.thickness.numerical_error + b.thickness.numerical_error);
            assert_near(b.thickness.value, a.thickness.value, 1e-9);
        }
    }
    /* damage transport is the rate balance started at the incubation time */
    one.parameters.start_thickness = 0;
    rig late = one;
    late.parameters.incubation = true;
    const double incubation = balance_of(&late).incubation_time.value;
    for (double time = 1; time < 1e5; time *= 4.7)
        assert_near(point_at(&late, incubation + time).thickness.value,
                    point_at(&one, time).thickness.value, 1e-9);
    rig_free(&one);
    rig_free(&two);
}

static void restart_changes_nothing(void **state)
{
    (void)state;
    rig r = rig_several();
    for (double time = 1e-6; time < 1e6; time *= 11) {
        r.parameters.start_thickness = 0;
        const double whole = point_at(&r, time).thickness.value;
        r.parameters.start_thickness = point_at(&r, 0.385 * time).thickness.value;
        assert_near(point_at(&r, 0.615 * time).thickness.value, whole, 1e-9);
    }
    rig_free(&r);
}

/* The remainder of an old layer is only known to rounding. */
static void old_layer_has_an_error(void **state)
{
    (void)state;
    rig r = rig_several();
    r.parameters.incubation = true;
    r.parameters.start_thickness = 1e-3;
    const wt_layer_point p = point_at(&r, 1e-9);
    assert_near(p.thickness.value, 1e-3, 1e-9);
    assert_true(p.thickness.numerical_error >= 1e-3 * 0x1p-53);
    assert_true(p.thickness.numerical_error <= 1e-3 * 1e-12);
    rig_free(&r);
}

/* All power at one wavenumber, and wear slightly faster than the formation: no layer, but one of
 * log(1.001 / 1.0005) / kappa if the formation is higher by its error. */
static void an_error_may_be_a_layer(void **state)
{
    (void)state;
    rig r = rig_mild();
    const double formation = 400 / 2e10, higher = log(1.001 / 1.0005) / 2e6;
    r.source.numerical_error = 1e-3;
    r.parameters.specific_wear_rate =
        1.0005 * formation / (r.parameters.pressure * r.parameters.velocity);
    const wt_layer_point p = point_at(&r, 1e3);
    assert_true(p.thickness.value == 0);
    assert_near(p.thickness.numerical_error, higher, 1e-6);
    rig_free(&r);
}

/* Thickness never decreases during growth from 0, never increases during shrinkage, and both limits
 * meet. */
static void thickness_is_monotonic(void **state)
{
    (void)state;
    rig r = rig_several();
    const wt_layer_steady_state b = balance_of(&r);
    enum { TIMES = 120 };
    double time[TIMES];
    wt_layer_point up[TIMES], down[TIMES], damage[TIMES];
    for (size_t i = 0; i < TIMES; i++) /* any order */
        time[i] = 1e-9 * pow(10, 18.0 * (double)((i * 7) % TIMES) / TIMES);
    assert_int_equal(wt_layer_history(&r.source, &r.parameters, time, TIMES, up, NULL), WT_OK);
    r.parameters.start_thickness = 10 * b.thickness.value;
    assert_int_equal(wt_layer_history(&r.source, &r.parameters, time, TIMES, down, NULL), WT_OK);
    r.parameters.start_thickness = 0;
    r.parameters.incubation = true;
    assert_int_equal(wt_layer_history(&r.source, &r.parameters, time, TIMES, damage, NULL), WT_OK);
    for (size_t i = 0; i < TIMES; i++) {
        assert_true(up[i].thickness.value <= b.thickness.value * (1 + 1e-12));
        assert_true(down[i].thickness.value >= b.thickness.value * (1 - 1e-12));
        assert_true(damage[i].thickness.value <= up[i].thickness.value * (1 + 1e-9));
        for (size_t k = 0; k < TIMES; k++)
            if (time[k] > time[i]) {
                assert_true(up[k].thickness.value >= up[i].thickness.value);
                assert_true(down[k].thickness.value <= down[i].thickness.value);
                assert_true(damage[k].thickness.value >= damage[i].thickness.value);
            }
    }
    const size_t last = 17; /* (17 * 7) % 120 = 119 */
    assert_near(up[last].thickness.value, b.thickness.value, 1e-12);
    assert_near(down[last].thickness.value, b.thickness.value, 1e-12);
    assert_near(damage[last].thickness.value, b.thickness.value, 1e-12);
    rig_free(&r);
}

static void inputs_of_the_steady_state(void **state)
{
    (void)state;
    rig r = rig_several();
    const wt_layer_steady_state b = balance_of(&r);
    /* severity at a fixed k changes the clock only */
    rig severe = rig_several();
    for (size_t i = 0; i < 3; i++)
        severe.source.power[i] *= 2;
    severe.parameters.velocity *= 2;
    assert_near(balance_of(&severe).thickness.value, b.thickness.value, 1e-12);
    assert_near(point_at(&severe, 50).thickness.value, point_at(&r, 100).thickness.value, 1e-9);
    /* duty cycle: likewise */
    rig rare = rig_several();
    rare.parameters.duty = 0.01325359400733194;
    assert_near(balance_of(&rare).thickness.value, b.thickness.value, 1e-12);
    rare.parameters.incubation = r.parameters.incubation = true;
    assert_near(point_at(&rare, 1000 / rare.parameters.duty).thickness.value,
                point_at(&r, 1000).thickness.value, 1e-9);
    r.parameters.incubation = false;
    /* more energy, thicker; more wear, higher U_c or damage, thinner */
    severe.parameters.velocity /= 2;
    assert_true(balance_of(&severe).thickness.value > b.thickness.value);
    double *worse[] = {&r.parameters.specific_wear_rate, &r.parameters.critical_energy,
                       &r.parameters.damage};
    for (size_t i = 0; i < 3; i++) {
        *worse[i] *= 2;
        assert_true(balance_of(&r).thickness.value < b.thickness.value);
        *worse[i] /= 2;
    }
    /* z -> c z, q -> q / c */
    rig coarse = rig_several();
    for (size_t i = 0; i < 3; i++)
        coarse.source.wavenumber[i] /= 17;
    assert_near(balance_of(&coarse).thickness.value, 17 * b.thickness.value, 1e-12);
    rig_free(&r);
    rig_free(&severe);
    rig_free(&rare);
    rig_free(&coarse);
}

static void regimes(void **state)
{
    (void)state;
    rig r = rig_mild();
    const double critical = balance_of(&r).critical_specific_wear_rate;
    const struct {
        double k;
        wt_layer_regime regime;
    } table[] = {{2 * critical, WT_LAYER_NONE},
                 {critical / 1.5, WT_LAYER_THIN},
                 {critical / 3, WT_LAYER_THICK},
                 {0, WT_LAYER_THICK}};
    for (size_t i = 0; i < 4; i++) {
        r.parameters.specific_wear_rate = table[i].k;
        const wt_layer_steady_state b = balance_of(&r);
        assert_int_equal(b.regime, table[i].regime);
        assert_int_equal(b.thickness.value > 0, table[i].regime != WT_LAYER_NONE);
        assert_int_equal(isnan(b.removal_time.value), table[i].regime != WT_LAYER_NONE);
    }
    assert_true(isinf(balance_of(&r).thickness.value));
    assert_true(isinf(balance_of(&r).ratio));
    rig_free(&r);
}

/* The critical energy is recovered from its steady state. */
static void calibration(void **state)
{
    (void)state;
    rig r = rig_several();
    r.parameters.damage = 3;
    r.parameters.duty = 0.2;
    const double thickness = balance_of(&r).thickness.value;
    assert_true(thickness > 0);
    assert_near(wt_layer_calibrate(&r.source, &r.parameters, thickness),
                r.parameters.critical_energy, 1e-9);
    rig_free(&r);
}

static bool whole(double x)
{
    return !isnan(x);
}

/* No NaN without dissipation. */
static void no_dissipation(void **state)
{
    (void)state;
    for (unsigned bits = 0; bits < 128; bits++) {
        rig r = bits & 1 ? rig_several() : rig_mild();
        if (bits & 2)
            for (size_t i = 0; i < r.source.n; i++)
                r.source.power[i] = 0;
        if (bits & 4)
            r.parameters.specific_wear_rate = 0;
        if (bits & 8)
            r.parameters.velocity = 0;
        if (bits & 16)
            r.parameters.start_thickness = 1e-6;
        if (bits & 32)
            r.parameters.incubation = true;
        if (bits & 64)
            r.source.profile = WT_PROFILE_INCOMPRESSIBLE;
        const wt_layer_steady_state b = balance_of(&r);
        assert_true(whole(b.surface_power) && whole(b.formation_rate_zero) && whole(b.wear_rate));
        assert_true(whole(b.ratio) && whole(b.critical_specific_wear_rate));
        assert_true(whole(b.thickness.value) && whole(b.thickness.numerical_error));
        assert_true(whole(b.eigenvalue) && whole(b.relaxation_time.value));
        const double times[] = {0, 1e-9, 1, 1e9};
        wt_layer_point p[4];
        assert_int_equal(wt_layer_history(&r.source, &r.parameters, times, 4, p, NULL), WT_OK);
        for (size_t i = 0; i < 4; i++) {
            assert_true(p[i].thickness.value >= 0 && isfinite(p[i].thickness.value));
            assert_true(p[i].thickness.numerical_error >= 0);
            assert_true(isfinite(p[i].thickness.numerical_error));
            assert_true(isfinite(p[i].formation_rate) && isfinite(p[i].wear_rate));
        }
        assert_near(p[0].thickness.value, r.parameters.start_thickness, 0);
        rig_free(&r);
    }
    assert_true(isnan(wt_layer_exponential_thickness(-1, 1, 1, 1, 1)));
    assert_true(isnan(wt_layer_exponential_thickness(0, 1, (double)NAN, 1, 1)));
}

static void same_value(wt_estimate full, wt_estimate alone)
{
    assert_memory_equal(&full.value, &alone.value, sizeof full.value);
    if (full.numerical_error > 0) /* otherwise there is certainly none, which costs nothing */
        assert_true(isnan(alone.numerical_error));
}

/* The thickness with time without an error equals that with one, to 1e-7. */
static void near_thickness(wt_estimate full, wt_estimate alone)
{
    assert_true(fabs(alone.value - full.value) <= 1e-7 * full.value);
    if (full.numerical_error > 0 && alone.value > 0)
        assert_true(isnan(alone.numerical_error));
}

static void history_alone(rig *r, const double *time, size_t n)
{
    wt_layer_parameters *p = &r->parameters;
    wt_layer_point *full = wt_alloc(n, sizeof *full), *alone = wt_alloc(n, sizeof *alone);
    for (int incubates = 0; incubates < 2; incubates++) {
        p->incubation = incubates != 0;
        p->skip_numerical_errors = false;
        assert_int_equal(wt_layer_history(&r->source, p, time, n, full, NULL), WT_OK);
        p->skip_numerical_errors = true;
        assert_int_equal(wt_layer_history(&r->source, p, time, n, alone, NULL), WT_OK);
        for (size_t i = 0; i < n; i++)
            near_thickness(full[i].thickness, alone[i].thickness);
    }
    free(full);
    free(alone);
}

/* Otherwise a result that is not requested changes no bit of the others. */
static void results_without_errors(void **state)
{
    (void)state;
    enum { TIMES = 40 };
    for (int way = 0; way < 8; way++) {
        rig r = rig_several();
        wt_layer_parameters *p = &r.parameters;
        r.source.profile = (way & 1) != 0 ? WT_PROFILE_INCOMPRESSIBLE : WT_PROFILE_PERSSON;
        p->incubation = true;
        p->specific_wear_rate = (way & 2) != 0 ? 1e-12 : 1e-9; /* with and without a layer */
        p->start_thickness = (way & 4) != 0 ? 1e-6 : 0;
        const wt_layer_steady_state full = balance_of(&r);
        wt_estimate time[2], goal = {0.9 * full.thickness.value, 0, 0, "m"};
        double at[TIMES];
        for (size_t i = 0; i < TIMES; i++)
            at[i] = 1e-2 * pow(10, 0.3 * (double)i);
        history_alone(&r, at, TIMES);
        p->skip_numerical_errors = false;
        assert_int_equal(wt_layer_growth_time(&r.source, p, goal, &time[0], NULL), WT_OK);
        p->skip_numerical_errors = true;
        const wt_layer_steady_state alone = balance_of(&r);
        same_value(full.thickness, alone.thickness);
        same_value(full.incubation_time, alone.incubation_time);
        if (isfinite(full.relaxation_time.value))
            same_value(full.relaxation_time, alone.relaxation_time);
        assert_int_equal(wt_layer_growth_time(&r.source, p, goal, &time[1], NULL), WT_OK);
        if (!isnan(time[0].value))
            same_value(time[0], time[1]);
        p->skip_numerical_errors = false;
        p->balance_only = true;
        const wt_layer_steady_state only = balance_of(&r);
        assert_memory_equal(&full.thickness, &only.thickness, sizeof full.thickness);
        assert_true(isnan(only.incubation_time.value));
        rig_free(&r);
    }
}

static void bad_input(void **state)
{
    (void)state;
    const double nan = (double)NAN, infinite = (double)INFINITY;
    rig r = rig_mild();
    wt_layer_parameters *p = &r.parameters;
    const struct {
        const char *name;
        double *value;
        double bad[4];
    } table[] = {
        {"critical-energy", &p->critical_energy, {0, -1, nan, infinite}},
        {"damage", &p->damage, {0, -1, nan, infinite}},
        {"specific-wear-rate", &p->specific_wear_rate, {-1e-30, -1, nan, infinite}},
        {"pressure", &p->pressure, {-1, -1e-9, nan, infinite}},
        {"velocity", &p->velocity, {-1, -1e-9, nan, infinite}},
        {"start-thickness", &p->start_thickness, {-1, -1e-20, nan, infinite}},
        {"duty-cycle", &p->duty, {0, -1, nan, 1.01}},
        {"wavenumber", &r.source.wavenumber[0], {0, -1, nan, infinite}},
        {"power", &r.source.power[0], {-1, -1e-30, nan, infinite}},
        {"local-friction", &r.source.local_friction, {-1, -1e-9, nan, infinite}},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        for (size_t k = 0; k < 4; k++) {
            const double good = *table[i].value;
            *table[i].value = table[i].bad[k];
            wt_layer_steady_state b;
            wt_error err = WT_ERROR_INIT;
            assert_int_equal(wt_layer_steady_state_compute(&r.source, p, &b, &err), WT_E_RANGE);
            assert_true(strstr(err.message, table[i].name) != NULL ||
                        strcmp(err.place, table[i].name) == 0);
            assert_true(err.expected[0] != '\0' && err.found[0] != '\0');
            *table[i].value = good;
        }
    const double times[] = {1, -1};
    wt_layer_point points[2];
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_layer_history(&r.source, p, times, 2, points, &err), WT_E_RANGE);
    assert_non_null(strstr(err.message, "time 2 of 2"));
    rig_free(&r);
}

/* Formation so fast that its times are subnormal, and so deep that it underflows, terminates;
 * finally it follows 1/q ln t. */
static void fastest_formation(void **state)
{
    (void)state;
    double q[] = {1e3, 1e5, 1e7}, power[] = {1, 0.5, 0.1};
    wt_energy_source source = {
        .profile = WT_PROFILE_PERSSON, .n = 3, .wavenumber = q, .power = power};
    wt_layer_parameters p = wt_layer_defaults();
    p.critical_energy = 1e-300;
    p.pressure = 3e5;
    p.velocity = 1;
    p.start_thickness = 1e-6;
    const double time[] = {1e-300, 1, 1e300};
    wt_layer_point points[3];
    assert_int_equal(wt_layer_history(&source, &p, time, 3, points, NULL), WT_OK);
    for (size_t i = 0; i < 3; i++) { /* d delta/dt = exp(-2 q delta) / U of the longest wave */
        const double expected = (log(2 * q[0] * time[i]) - log(p.critical_energy)) / (2 * q[0]);
        assert_near(points[i].thickness.value, expected, i > 0 ? 1e-9 : 2e-3);
    }
    for (size_t i = 0; i < 3; i++)
        power[i] *= 1e300;
    p.critical_energy = 1;
    wt_layer_steady_state b;
    assert_int_equal(wt_layer_steady_state_compute(&source, &p, &b, NULL), WT_E_RANGE);
}

/* A band whose deepest position is only known to the accuracy of its logarithms. */
static void edge_within_rounding(void **state)
{
    (void)state;
    double q[] = {1e3, 1e5, 1e7}, power[] = {1e5, 5e4, 1e4};
    wt_energy_source source = {.profile = WT_PROFILE_INCOMPRESSIBLE,
                               .local_friction = 0.5,
                               .n = 3,
                               .wavenumber = q,
                               .power = power};
    wt_layer_parameters p = wt_layer_defaults();
    p.critical_energy = 1;
    p.specific_wear_rate = 1e-12;
    p.pressure = 3e5;
    p.velocity = 1;
    p.start_thickness = 1e-6;
    p.incubation = true;
    double last = 0;
    for (double t = 1e-3; t < 1e300; t *= 3) {
        wt_layer_point point;
        wt_error err = WT_ERROR_INIT;
        if (wt_layer_history(&source, &p, &t, 1, &point, &err) != WT_OK)
            fail_msg("%g s: %s", t, err.message);
        assert_true(point.thickness.value >= last - point.thickness.numerical_error);
        last = point.thickness.value;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numeric_cases),
        cmocka_unit_test(step_in_severity),
        cmocka_unit_test(buried_band),
        cmocka_unit_test(deep_band_from_its_onset),
        cmocka_unit_test(error_at_the_onset),
        cmocka_unit_test(bands_with_wear),
        cmocka_unit_test(time_to_a_thickness),
        cmocka_unit_test(three_methods_agree),
        cmocka_unit_test(restart_changes_nothing),
        cmocka_unit_test(old_layer_has_an_error),
        cmocka_unit_test(an_error_may_be_a_layer),
        cmocka_unit_test(thickness_is_monotonic),
        cmocka_unit_test(inputs_of_the_steady_state),
        cmocka_unit_test(regimes),
        cmocka_unit_test(calibration),
        cmocka_unit_test(no_dissipation),
        cmocka_unit_test(results_without_errors),
        cmocka_unit_test(bad_input),
        cmocka_unit_test(fastest_formation),
        cmocka_unit_test(edge_within_rounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
