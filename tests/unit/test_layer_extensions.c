/* The modified layer beyond the steady state at constant load, against numeric cases and laws. */
#include "assert_near.h"

#include "layer/numerics/layer_kernel.h"
#include "numeric/cases.h"
#include "weartrack/layer.h"

#include <float.h>

typedef struct rig {
    const numeric_case *c;
    wt_energy_source source;
    wt_layer_parameters p;
    double digits; /* relative accuracy that the reference claims */
} rig;

static double number(const numeric_case *c, const char *key, double missing)
{
    return case_number(c, false, key, missing);
}

static double digits_of(const numeric_case *c)
{
    return pow(10, -number(c, "digits", 12));
}

/* Power of the case at a velocity and pressure. */
static void set_load(rig *r, double pressure, double velocity, double mu)
{
    const case_line *share = case_find(r->c, false, "share");
    const case_line *power = case_find(r->c, false, "power");
    for (size_t i = 0; i < r->source.n; i++)
        r->source.power[i] =
            power != NULL ? power->value[i] : share->value[i] * mu * pressure * velocity;
    r->p.pressure = pressure;
    r->p.velocity = velocity;
}

static rig rig_of(const numeric_case *c)
{
    rig r = {.c = c, .p = wt_layer_defaults(), .digits = digits_of(c)};
    const case_line *q = case_find(c, false, "wavenumber");
    assert_non_null(q);
    r.source.n = q->n;
    r.source.wavenumber = malloc(q->n * sizeof(double));
    r.source.power = malloc(q->n * sizeof(double));
    memcpy(r.source.wavenumber, q->value, q->n * sizeof(double));
    r.source.profile = strcmp(case_word(c, false, "profile"), "incompressible") == 0
                           ? WT_PROFILE_INCOMPRESSIBLE
                           : WT_PROFILE_PERSSON;
    r.source.local_friction = number(c, "local_friction", 0);
    r.p.critical_energy = number(c, "critical_energy", (double)NAN);
    r.p.damage = number(c, "damage", 1);
    r.p.duty = number(c, "duty", 1);
    r.p.specific_wear_rate = number(c, "specific_wear_rate", 0);
    set_load(&r, number(c, "pressure", (double)NAN), number(c, "velocity", (double)NAN),
             number(c, "mu", 1));
    return r;
}

static wt_layer_steady_state balance_of(const rig *r)
{
    wt_layer_steady_state b;
    wt_error err = WT_ERROR_INIT;
    if (wt_layer_steady_state_compute(&r->source, &r->p, &b, &err) != WT_OK)
        fail_msg("%s: balance: %s", r->c->name, err.message);
    return b;
}

/* Near 0 the thickness may be below the rounding error. */
static void near_thickness_to(const rig *r, const char *what, double actual, double expected,
                              double digits)
{
    if (!(fabs(actual - expected) <= digits * expected + 1e-21))
        fail_msg("%s: %s %.17g is not %.17g, relative difference %.3g", r->c->name, what, actual,
                 expected, actual / expected - 1);
}

static void near_thickness(const rig *r, const char *what, double actual, double expected)
{
    near_thickness_to(r, what, actual, expected, r->digits);
}

/* By the rate balance, for which the reference has fewer digits in two cases. The largest
 * difference is 5e-11 at 600 s of two_waves_with_more_wear; an integral with 30 digits confirms the
 * program. */
static void near_balance(const rig *r, const char *what, double actual, double expected)
{
    const double digits = number(r->c, "balance_digits", (double)NAN);
    near_thickness_to(r, what, actual, expected, isnan(digits) ? r->digits : pow(10, -digits));
}

/* ---- lines of a case ------------------------------------------------------------------------- */

static bool check_time(const rig *r, const case_line *line)
{
    static const char *const keys[] = {"transport", "balance"};
    rig at = *r;
    size_t which = 0;
    while (which < 2 && strcmp(line->key, keys[which]) != 0)
        which++;
    if (which == 2)
        return false;
    at.p.incubation = which == 0;
    wt_layer_point point;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_layer_history(&at.source, &at.p, line->value, 1, &point, &err), WT_OK);
    if (which == 1) {
        near_balance(r, line->key, point.thickness.value, line->value[1]);
        return true;
    }
    near_thickness(r, line->key, point.thickness.value, line->value[1]);
    return true;
}

enum { STAGES = 4 };

/* Sequences of loads. */
typedef struct chain {
    size_t n;
    rig rig[STAGES];
    double duration[STAGES];
} chain;

static void chain_make(chain *h, const numeric_case *c)
{
    *h = (chain){0};
    for (size_t i = 0; i < c->n; i++) {
        const case_line *l = &c->lines[i];
        if (l->expected || strcmp(l->key, "stage") != 0)
            continue;
        rig *r = &h->rig[h->n];
        *r = rig_of(c);
        set_load(r, l->value[0], l->value[1], l->value[5]);
        r->p.specific_wear_rate = l->value[3];
        h->duration[h->n++] = l->value[4];
    }
}

static void chain_free(chain *h)
{
    for (size_t i = 0; i < h->n; i++)
        wt_energy_source_clear(&h->rig[i].source);
}

/* Each load continues from the thickness of the previous one: correct by the rate balance, wrong by
 * damage transport. */
static double chain_thickness(const chain *h, double time, bool transport)
{
    double thickness = 0;
    for (size_t i = 0; i < h->n && time > 0; i++) {
        wt_layer_parameters p = h->rig[i].p;
        const double lasts = i + 1 < h->n && time > h->duration[i] ? h->duration[i] : time;
        wt_layer_point point;
        wt_error err = WT_ERROR_INIT;
        p.start_thickness = thickness;
        p.incubation = transport;
        assert_int_equal(wt_layer_history(&h->rig[i].source, &p, &lasts, 1, &point, &err), WT_OK);
        thickness = point.thickness.value;
        time -= lasts;
    }
    return thickness;
}

static bool check_chain(const rig *r, const case_line *line)
{
    const double *v = line->value;
    chain h;
    chain_make(&h, r->c);
    bool known = h.n > 0;
    if (known && strcmp(line->key, "chain") == 0)
        near_balance(r, "chain", chain_thickness(&h, v[0], false), v[1]);
    else if (known && strcmp(line->key, "thickness_only_restart") == 0)
        near_thickness(r, line->key, chain_thickness(&h, v[0], true), v[1]);
    else
        known = false;
    chain_free(&h);
    return known;
}

static bool check_growth_time(const rig *r, const case_line *line)
{
    const double *v = line->value;
    const bool ode = strcmp(line->key, "time_ode") == 0;
    rig at = *r;
    wt_estimate time;
    wt_error err = WT_ERROR_INIT;
    if (!ode && strcmp(line->key, "time_transport") != 0)
        return false;
    at.p.incubation = !ode;
    assert_int_equal(
        wt_layer_growth_time(&at.source, &at.p, (wt_estimate){.value = v[0]}, &time, &err), WT_OK);
    assert_near(time.value, v[1], r->digits);
    return true;
}

/* Where w of two waves begins or ceases to have two maxima, its slope and curvature are 0. */
static bool check_second_maximum(const case_line *line)
{
    if (strcmp(line->key, "second_maximum") != 0)
        return false;
    for (size_t i = 1; i + 1 < line->n; i += 2) {
        const double ratio = line->value[i], depth = line->value[i + 1], step = 1e-5;
        const double q_min = fmin(1, line->value[0]);
        wt_energy_source s = {.profile = WT_PROFILE_INCOMPRESSIBLE,
                              .n = 2,
                              .wavenumber = (double[]){1, line->value[0]},
                              .power = (double[]){1, ratio}};
        const energy_expansion here = energy_expand(&s, q_min, depth, 0, 0);
        const energy_expansion above = energy_expand(&s, q_min, depth - step, 0, 0);
        const energy_expansion below = energy_expand(&s, q_min, depth + step, 0, 0);
        assert_near_abs(here.slope, 0, 1e-10 * here.value);
        assert_near_abs(exp(above.log_scale) * above.slope - exp(below.log_scale) * below.slope, 0,
                        1e-4 * line->value[0] * line->value[0] * step * exp(here.log_scale) *
                            here.value);
    }
    return true;
}

static bool check_number(const rig *r, const case_line *line)
{
    const double *v = line->value;
    rig at = *r;
    if (strcmp(line->key, "thickness") == 0)
        near_thickness(r, line->key, balance_of(r).thickness.value, *v);
    else if (strcmp(line->key, "ratio") == 0)
        assert_near(balance_of(r).ratio, *v, r->digits);
    else if (strcmp(line->key, "power") == 0)
        assert_near(balance_of(r).surface_power, *v, r->digits);
    else if (strcmp(line->key, "wear_rate") == 0)
        assert_near(balance_of(r).wear_rate, *v, r->digits);
    else if (strcmp(line->key, "eigenvalue") == 0)
        assert_near(balance_of(r).eigenvalue, *v, r->digits);
    else if (strcmp(line->key, "sensitivity") == 0)
        assert_near(-balance_of(r).wear_rate * balance_of(r).relaxation_time.value, *v, r->digits);
    else if (strcmp(line->key, "balance_of_ratio") == 0) {
        at.p.specific_wear_rate = v[1] / (r->p.pressure * r->p.velocity);
        const wt_layer_steady_state b = balance_of(&at);
        /* R - 1 of 1e-6 has ten digits itself */
        assert_near_abs(b.ratio, v[0], 1e-14 * v[0]);
        assert_near_abs(b.thickness.value, v[2], b.thickness.numerical_error);
        assert_true(b.thickness.numerical_error <= 1e-8 * v[2]);
        assert_near(-b.wear_rate * b.relaxation_time.value, v[3], 1e-9);
    } else
        return false;
    return true;
}

static void check_case(const numeric_case *c)
{
    rig r = {.c = c, .digits = digits_of(c)};
    if (case_find(c, false, "wavenumber") != NULL)
        r = rig_of(c);
    for (size_t i = 0; i < c->n; i++) {
        const case_line *line = &c->lines[i];
        if (!line->expected)
            continue;
        if (!check_second_maximum(line) && !check_chain(&r, line) && !check_time(&r, line) &&
            !check_growth_time(&r, line) && !check_number(&r, line))
            fail_msg("%s: what is %s?", c->name, line->key);
    }
    wt_energy_source_clear(&r.source);
}

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/layer-beyond.txt", "r");
    numeric_case *c = malloc(sizeof *c);
    size_t cases = 0;
    assert_non_null(in);
    assert_non_null(c);
    for (; case_read(in, c); cases++)
        check_case(c);
    assert_int_equal(cases, 25);
    fclose(in);
    free(c);
}

/* ---- laws ------------------------------------------------------------------------------------ */

/* An error of the power is part of R, critical wear rate, thickness and times. */
static void errors_of_the_power(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        const double error = 1e-6;
        double power[2][2] = {{400, 300}, {400 * (1 + error), 300 * (1 + error)}};
        wt_energy_source source = {.n = 2,
                                   .wavenumber = (double[]){1e6, 4e6},
                                   .profile = WT_PROFILE_PERSSON,
                                   .numerical_error = error};
        wt_layer_parameters p = wt_layer_defaults();
        wt_layer_steady_state b[2];
        wt_layer_point point[2];
        wt_error err = WT_ERROR_INIT;
        const double start = k < 2 ? 0 : 5e-6;
        p.pressure = 4e5;
        p.velocity = 5e-3;
        p.critical_energy = k < 2 ? 2e8 : 2e10;
        p.specific_wear_rate = 3.44e-10;
        p.start_thickness = start;
        p.incubation = k % 2;
        for (int i = 0; i < 2; i++) {
            source.power = power[i];
            assert_int_equal(wt_layer_steady_state_compute(&source, &p, &b[i], &err), WT_OK);
        }
        const double moved = fabs(b[1].ratio / b[0].ratio - 1);
        assert_int_equal(b[0].ratio > 1, k < 2);
        assert_true(moved > 0.99 * error && moved < b[0].ratio_error * (1 + 1e-3));
        assert_true(fabs(b[1].critical_specific_wear_rate / b[0].critical_specific_wear_rate - 1) <
                    b[0].ratio_error * (1 + 1e-3));
        assert_true(fabs(b[1].thickness.value - b[0].thickness.value) <=
                    b[0].thickness.numerical_error * (1 + 1e-3));
        for (double time = 1; time < 1e6; time *= 10) {
            for (int i = 0; i < 2; i++) {
                source.power = power[i];
                assert_int_equal(wt_layer_history(&source, &p, &time, 1, &point[i], &err), WT_OK);
            }
            assert_true(fabs(point[1].thickness.value - point[0].thickness.value) <=
                        point[0].thickness.numerical_error * (1 + 1e-3));
        }
    }
}

static void refuses(void **state)
{
    (void)state;
    wt_energy_source source = {.n = 1,
                               .wavenumber = (double[]){1e6},
                               .power = (double[]){400},
                               .profile = WT_PROFILE_PERSSON};
    wt_layer_parameters p = wt_layer_defaults();
    wt_layer_steady_state b;
    wt_error err = WT_ERROR_INIT;
    p.pressure = 4e5;
    p.velocity = 5e-3;
    p.critical_energy = (double)NAN;
    assert_int_equal(wt_layer_steady_state_compute(&source, &p, &b, &err), WT_E_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numeric_cases),
        cmocka_unit_test(errors_of_the_power),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
