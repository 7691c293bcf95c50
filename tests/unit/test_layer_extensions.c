/* The modified layer beyond the balance at constant load, against numeric cases and laws. */
#include "near.h"

#include "layer/numerics/layer_kernel.h"
#include "numeric/cases.h"
#include "weartrack/layer.h"

#include <float.h>

typedef struct rig {
    const numeric_case *c;
    wt_energy_source source;
    wt_layer_parameters p;
    double digits; /* that the reference trusts, relative */
} rig;

static double number(const numeric_case *c, const char *key, double missing)
{
    return case_number(c, false, key, missing);
}

static double digits_of(const numeric_case *c)
{
    return pow(10, -number(c, "digits", 12));
}

/* mu at a velocity. */
static double mu_at(const numeric_case *c, double velocity)
{
    const case_line *peak = case_find(c, false, "mu_peak");
    if (peak == NULL)
        return number(c, "mu", 1);
    const double decades = log10(velocity / peak->value[2]);
    return peak->value[0] * exp(-peak->value[1] * decades * decades);
}

/* The power of the case at a velocity and pressure. */
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
    r.p.severity_power = number(c, "severity_power", 0);
    r.p.severity_exponent = number(c, "severity_exponent", 1);
    const double velocity = number(c, "velocity", (double)NAN);
    set_load(&r, number(c, "pressure", (double)NAN), velocity, mu_at(c, velocity));
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

static double deepest(const wt_layer_section *s)
{
    return s->n > 0 ? s->band[0].lower.value : 0;
}

static wt_layer_section section_of(const wt_layer_load *stages, size_t n, double time)
{
    wt_layer_section s;
    wt_error err = WT_ERROR_INIT;
    if (wt_layer_sections(stages, n, &time, 1, &s, &err) != WT_OK)
        fail_msg("section: %s", err.message);
    return s;
}

/* Near 0 the thickness may be below what rounding leaves. */
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

/* By the rate balance, for which the reference has fewer digits in two cases: where it differs
 * most, by 5e-11 at 600 s of two_waves_with_more_wear, an integral in 30 digits gives the number of
 * the program. */
static void near_balance(const rig *r, const char *what, double actual, double expected)
{
    const double digits = number(r->c, "balance_digits", (double)NAN);
    near_thickness_to(r, what, actual, expected, isnan(digits) ? r->digits : pow(10, -digits));
}

/* ---- lines of a case ------------------------------------------------------------------------- */

/* One load: its history and its sections must both know. */
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
    const wt_layer_load stage = {&at.source, at.p, 1};
    const wt_layer_section s = section_of(&stage, 1, line->value[0]);
    near_thickness(r, "section", deepest(&s), line->value[1]);
    return true;
}

static void check_edges(const rig *r, const wt_layer_section *s, const double *edge, size_t n)
{
    if (s->n != n / 2)
        fail_msg("%s: %zu bands at %.17g s, not %zu", r->c->name, s->n, s->time, n / 2);
    for (size_t i = 0; i < s->n; i++) {
        assert_near(s->band[i].upper.value, edge[2 * i], r->digits);
        assert_near(s->band[i].lower.value, edge[2 * i + 1], r->digits);
        assert_true(fabs(s->band[i].lower.value - edge[2 * i + 1]) <=
                    s->band[i].lower.numerical_error + 1e-14 * edge[2 * i + 1]);
        assert_true(s->band[i].lower.numerical_error <= 1e-9 * edge[2 * i + 1]);
    }
}

static bool check_bands(const rig *r, const case_line *line, const wt_layer_event *events, size_t n)
{
    static const char *const kinds[] = {"band_onset", "surface_onset", "surface_reached",
                                        "bands_merge"};
    const wt_layer_load stage = {&r->source, r->p, 1};
    if (strcmp(line->key, "bands") == 0) {
        const wt_layer_section s = section_of(&stage, 1, line->value[0]);
        check_edges(r, &s, line->value + 1, line->n - 1);
        return true;
    }
    for (size_t k = 0; k < 4; k++) {
        if (strcmp(line->key, kinds[k]) != 0)
            continue;
        size_t i = 0;
        while (i < n && (events[i].kind != (wt_layer_event_kind)k ||
                         fabs(events[i].time / line->value[0] - 1) > r->digits))
            i++;
        if (i == n)
            fail_msg("%s: no %s at %.17g s", r->c->name, line->key, line->value[0]);
        assert_near(events[i].depth, line->value[1], r->digits);
        return true;
    }
    return false;
}

enum { STAGES = 4 };

/* Loads that follow one another. */
typedef struct chain {
    size_t n;
    rig rig[STAGES];
    wt_layer_load stage[STAGES];
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
        h->stage[h->n++] = (wt_layer_load){&r->source, r->p, l->value[4]};
    }
    for (size_t i = 0; i < h->n; i++)
        h->stage[i].source = &h->rig[i].source;
}

static void chain_free(chain *h)
{
    for (size_t i = 0; i < h->n; i++)
        wt_energy_source_clear(&h->rig[i].source);
}

/* Each load goes on from the thickness that the last one left: right by the rate balance, wrong by
 * the transport of damage. */
static double chain_thickness(const chain *h, double time, bool transport)
{
    double thickness = 0;
    for (size_t i = 0; i < h->n && time > 0; i++) {
        wt_layer_parameters p = h->stage[i].parameters;
        const double lasts =
            i + 1 < h->n && time > h->stage[i].duration ? h->stage[i].duration : time;
        wt_layer_point point;
        wt_error err = WT_ERROR_INIT;
        p.start_thickness = thickness;
        p.incubation = transport;
        assert_int_equal(wt_layer_history(h->stage[i].source, &p, &lasts, 1, &point, &err), WT_OK);
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
    if (!known)
        return false;
    const wt_layer_section s = section_of(h.stage, h.n, v[0]);
    if (strcmp(line->key, "chain") == 0)
        near_balance(r, "chain", chain_thickness(&h, v[0], false), v[1]);
    else if (strcmp(line->key, "thickness_only_restart") == 0)
        near_thickness(r, line->key, chain_thickness(&h, v[0], true), v[1]);
    else if (strcmp(line->key, "section") == 0) {
        assert_near(s.worn, v[1], r->digits);
        check_edges(r, &s, v + 2, line->n - 2);
    } else if (strcmp(line->key, "damage_at") == 0) {
        double damage;
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_layer_damage(h.stage, h.n, v[0], v[1], &damage, &err), WT_OK);
        assert_near(damage, v[2], r->digits);
    } else
        known = false;
    chain_free(&h);
    return known;
}

/* Thickness and its derivatives: d ln Qf - d ln Qw over the decay of Qf. */
static void check_severity(const rig *r, const case_line *line)
{
    const double *v = line->value, m = r->p.severity_exponent;
    rig at = *r;
    set_load(&at, r->p.pressure, v[0], mu_at(r->c, v[0]));
    const wt_layer_steady_state b = balance_of(&at);
    assert_near(b.surface_power, v[1], r->digits);
    assert_near(b.wear_rate / (r->p.pressure * v[0]), v[2], r->digits);
    assert_near(b.ratio, v[3], r->digits);
    near_thickness(r, "severity", b.thickness.value, v[4]);
    if (line->n < 13)
        return;
    const double scale = b.wear_rate * b.relaxation_time.value; /* 1 / decay */
    const double x = v[1] / r->p.severity_power, s = pow(x, m) / (1 + pow(x, m));
    const double derivative[] = {(1 - m * s) * scale,     -scale,        m * s * scale,
                                 -m * s * log(x) * scale, -scale,        -b.thickness.value,
                                 -m * s * scale,          -m * s * scale};
    for (size_t i = 0; i < 8; i++)
        assert_near_abs(derivative[i], v[5 + i], 1e-10 * fabs(v[5 + i]) + 1e-12 * scale);
}

static bool check_running_in(const rig *r, const case_line *line)
{
    const double *v = line->value, pressure = r->p.pressure;
    const double area = number(r->c, "area", 0), bulk = number(r->c, "shear_stress", 0);
    wt_layer_shear shear = wt_layer_shear_defaults();
    shear.exponent = number(r->c, "exponent", 1);
    const double mu = mu_at(r->c, r->p.velocity);
    wt_layer_state layer = {.modulus_ratio = number(r->c, "modulus_ratio", 1)};
    const bool ode = strcmp(line->key, "time_ode") == 0;
    if (ode || strcmp(line->key, "time_transport") == 0) {
        rig at = *r;
        wt_estimate time;
        wt_error err = WT_ERROR_INIT;
        at.p.incubation = !ode;
        assert_int_equal(
            wt_layer_growth_time(&at.source, &at.p, (wt_estimate){.value = v[0]}, &time, &err),
            WT_OK);
        assert_near(time.value, v[1], r->digits);
        return true;
    }
    const bool friction = strcmp(line->key, "friction") == 0;
    if (strcmp(line->key, "tau_layer") == 0) {
        layer.thickness = balance_of(r).thickness.value;
        assert_near(wt_layer_shear_stress(&shear, bulk, layer), *v, r->digits);
        return true;
    }
    if (!friction && strncmp(line->key, "mu_", 3) != 0)
        return false;
    layer.thickness = friction                             ? v[0]
                      : strcmp(line->key, "mu_start") == 0 ? 0
                                                           : balance_of(r).thickness.value;
    const double jump = mu + wt_layer_shear_stress(&shear, bulk, layer) * area / pressure;
    shear.transition_thickness = number(r->c, "reach", 0);
    const double slow = mu + wt_layer_shear_stress(&shear, bulk, layer) * area / pressure;
    if (friction || strcmp(line->key, "mu_end_saturating") != 0)
        assert_near(jump, v[friction], r->digits);
    if (friction || strcmp(line->key, "mu_end_switch") != 0)
        assert_near(slow, v[friction ? 2 : 0], r->digits);
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
    else if (strcmp(line->key, "ratio_of_least_power") == 0) {
        at.p.severity_power = 0; /* constant k, to which it falls */
        set_load(&at, r->p.pressure, 1, mu_at(r->c, 1));
        assert_near(balance_of(&at).ratio, *v, r->digits);
    } else if (strcmp(line->key, "balance_of_ratio") == 0) {
        at.p.specific_wear_rate = v[1] / (r->p.pressure * r->p.velocity);
        const wt_layer_steady_state b = balance_of(&at);
        /* R - 1 of 1e-6 has ten digits itself */
        assert_near_abs(b.ratio, v[0], 1e-14 * v[0]);
        assert_near_abs(b.thickness.value, v[2], b.thickness.numerical_error);
        assert_true(b.thickness.numerical_error <= 1e-8 * v[2]);
        assert_near(-b.wear_rate * b.relaxation_time.value, v[3], 1e-9);
    } else if (strcmp(line->key, "critical_power") == 0) {
        set_load(&at, r->p.pressure, *v / (mu_at(r->c, 1) * r->p.pressure), mu_at(r->c, 1));
        assert_near(balance_of(&at).surface_power, *v, r->digits);
        assert_near(balance_of(&at).ratio, 1, r->digits);
    } else if (strcmp(line->key, "ratio_at_velocity") == 0 ||
               strcmp(line->key, "thickness_at_velocity") == 0 ||
               strcmp(line->key, "power_at_velocity") == 0) {
        set_load(&at, r->p.pressure, v[0], mu_at(r->c, v[0]));
        if (line->key[0] == 'p')
            assert_near(balance_of(&at).surface_power, v[1], r->digits);
        else if (line->key[0] == 'r') /* with the digits of the velocity, at the edges */
            assert_near(balance_of(&at).ratio, v[1], 1e-11);
        else
            near_thickness(r, line->key, balance_of(&at).thickness.value, v[1]);
    } else
        return false;
    return true;
}

static bool is_event(const char *key)
{
    return strstr(key, "_onset") != NULL || strstr(key, "_reached") != NULL ||
           strstr(key, "_merge") != NULL;
}

static void check_case(const numeric_case *c)
{
    rig r = {.c = c, .digits = digits_of(c)};
    if (case_find(c, false, "wavenumber") != NULL)
        r = rig_of(c);
    enum { EVENTS = 16 };
    wt_layer_event events[EVENTS];
    size_t n = 0, told = 0;
    wt_error err = WT_ERROR_INIT;
    for (size_t i = 0; i < c->n; i++)
        told += c->lines[i].expected && is_event(c->lines[i].key);
    if (told > 0) {
        assert_int_equal(wt_layer_events(&r.source, &r.p, events, EVENTS, &n, &err), WT_OK);
        for (size_t i = 0; n != told && i < n && i < EVENTS; i++)
            print_error("%s: event %d at %.17g s, %.17g m\n", c->name, (int)events[i].kind,
                        events[i].time, events[i].depth);
        assert_int_equal(n, told);
    }
    for (size_t i = 0; i < c->n; i++) {
        const case_line *line = &c->lines[i];
        if (!line->expected)
            continue;
        if (strcmp(line->key, "severity") == 0)
            check_severity(&r, line);
        else if (!check_second_maximum(line) && !check_chain(&r, line) && !check_time(&r, line) &&
                 !check_bands(&r, line, events, n) && !check_running_in(&r, line) &&
                 !check_number(&r, line))
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
    assert_true(cases >= 28);
    fclose(in);
    free(c);
}

/* ---- laws ------------------------------------------------------------------------------------ */

/* A load that is cut in two changes nothing, from picoseconds to 30,000 years. */
static void restart_changes_nothing(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        wt_energy_source source = {.profile = k ? WT_PROFILE_INCOMPRESSIBLE : WT_PROFILE_PERSSON,
                                   .local_friction = 0.2,
                                   .n = 3,
                                   .wavenumber = (double[]){3e4, 4.1e5, 6e6},
                                   .power = (double[]){120, 90, 200}};
        wt_layer_parameters p = wt_layer_defaults();
        p.pressure = 4e5;
        p.velocity = 5e-3;
        size_t layers = 0;
        for (double time = 1e-12; time < 2e12; time *= 10) {
            /* as much energy and as little wear as make a layer in that time */
            p.critical_energy = 2e8 * time;
            p.specific_wear_rate = 1e-8 / (time * p.pressure * p.velocity);
            const wt_layer_load whole = {&source, p, time};
            const wt_layer_section one = section_of(&whole, 1, time);
            for (double share = 1e-9; share < 1; share = share < 0.1 ? 100 * share : 0.37 + share) {
                const wt_layer_load cut[] = {{&source, p, share * time},
                                             {&source, p, 0.3 * (1 - share) * time},
                                             {&source, p, 1}};
                const wt_layer_section other = section_of(cut, 3, time);
                assert_int_equal(one.n, other.n);
                for (size_t i = 0; i < one.n; i++) {
                    assert_near(other.band[i].upper.value, one.band[i].upper.value, 1e-11);
                    assert_near(other.band[i].lower.value, one.band[i].lower.value, 1e-11);
                }
            }
            layers += one.n > 0;
        }
        if (layers < 24)
            fail_msg("rig %d: layers at %zu times only", k, layers);
    }
}

/* Where k is constant and where its growth has no power to work on, the numbers are the same. */
static void severity_off_changes_nothing(void **state)
{
    (void)state;
    wt_energy_source source = {.n = 1,
                               .wavenumber = (double[]){1e6},
                               .power = (double[]){400},
                               .profile = WT_PROFILE_PERSSON};
    wt_layer_parameters p = wt_layer_defaults();
    wt_layer_steady_state plain, other;
    wt_error err = WT_ERROR_INIT;
    p.critical_energy = 2e10;
    p.specific_wear_rate = 1e-12;
    p.pressure = 4e5;
    p.velocity = 5e-3;
    assert_int_equal(wt_layer_steady_state_compute(&source, &p, &plain, &err), WT_OK);
    p.severity_exponent = 3;
    assert_int_equal(wt_layer_steady_state_compute(&source, &p, &other, &err), WT_OK);
    assert_memory_equal(&plain.thickness.value, &other.thickness.value, sizeof(double));
    p.severity_power = 400; /* k is twice as large */
    assert_int_equal(wt_layer_steady_state_compute(&source, &p, &other, &err), WT_OK);
    assert_near(other.wear_rate, 2 * plain.wear_rate, 1e-15);
}

/* An error of the power is in R, critical wear rate, thickness and times, as the severity
 * magnifies it. */
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
        p.specific_wear_rate = 1e-12;
        p.start_thickness = start;
        p.incubation = k % 2;
        p.severity_power = 100;
        p.severity_exponent = 3;
        for (int i = 0; i < 2; i++) {
            source.power = power[i];
            assert_int_equal(wt_layer_steady_state_compute(&source, &p, &b[i], &err), WT_OK);
        }
        const double moved = fabs(b[1].ratio / b[0].ratio - 1);
        assert_int_equal(b[0].ratio > 1, k < 2);
        assert_true(moved > 1.5 * error && moved < b[0].ratio_error);
        assert_true(fabs(b[1].critical_specific_wear_rate / b[0].critical_specific_wear_rate - 1) <
                    b[0].ratio_error);
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

/* A load in parts has the events of that load. */
static void events_in_parts(void **state)
{
    (void)state;
    enum { MOST = 8 };
    wt_energy_source source = {.profile = WT_PROFILE_INCOMPRESSIBLE,
                               .n = 2,
                               .wavenumber = (double[]){1e5, 6e5},
                               .power = (double[]){120, 200}};
    wt_layer_parameters p = wt_layer_defaults();
    wt_layer_event whole[MOST], parts[MOST], first;
    size_t n_whole = 0, n_parts = 0;
    wt_error err = WT_ERROR_INIT;
    p.pressure = 4e5;
    p.velocity = 5e-3;
    p.critical_energy = 2e10;
    p.specific_wear_rate = 2e-14;
    assert_int_equal(wt_layer_events(&source, &p, whole, MOST, &n_whole, &err), WT_OK);
    assert_true(n_whole >= 2 && n_whole <= MOST);
    const wt_layer_load stages[] = {{&source, p, 0.4 * whole[0].time},
                                    {&source, p, whole[1].time - 0.7 * whole[0].time},
                                    {&source, p, 0}};
    assert_int_equal(wt_layer_load_events(stages, 3, parts, MOST, &n_parts, &err), WT_OK);
    assert_int_equal(n_parts, n_whole);
    for (size_t i = 0; i < n_whole; i++) {
        assert_int_equal(parts[i].kind, whole[i].kind);
        assert_near(parts[i].time, whole[i].time, 1e-11);
    }
    assert_int_equal(wt_layer_first_event(stages, 3, &first, &err), WT_OK);
    assert_near(first.time, whole[0].time, 2e-7);
}

/* A load that wears faster than it forms takes the layer away, and a later one gives it back. */
static void worn_off_and_back(void **state)
{
    (void)state;
    enum { MOST = 8 };
    wt_energy_source source = {.n = 1, .wavenumber = (double[]){1e6}, .power = (double[]){400}};
    wt_layer_parameters mild = wt_layer_defaults(), severe;
    wt_layer_event event[MOST], none;
    size_t n = 0;
    wt_error err = WT_ERROR_INIT;
    mild.pressure = 4e5;
    mild.velocity = 5e-3;
    mild.critical_energy = 2e10;
    mild.specific_wear_rate = 1e-12;
    severe = mild;
    severe.specific_wear_rate = 1e-10;
    const wt_layer_load stages[] = {
        {&source, mild, 1000}, {&source, severe, 100}, {&source, mild, 0}};
    assert_int_equal(wt_layer_load_events(stages, 3, event, MOST, &n, &err), WT_OK);
    assert_int_equal(n, 3);
    assert_int_equal(event[0].kind, WT_LAYER_SURFACE_ONSET);
    assert_int_equal(event[1].kind, WT_LAYER_WORN_OFF);
    assert_int_equal(event[2].kind, WT_LAYER_SURFACE_ONSET);
    assert_true(event[1].time > 1000 && event[1].time < 1100 && event[2].time > 1100);
    for (size_t i = 0; i < n; i++) {
        const wt_layer_section before = section_of(stages, 3, event[i].time * (1 - 1e-9)),
                               after = section_of(stages, 3, event[i].time * (1 + 1e-9));
        assert_int_equal(before.n, i % 2);
        assert_int_equal(after.n, 1 - i % 2);
    }
    const wt_layer_load always = {&source, severe, 0};
    assert_int_equal(wt_layer_first_event(&always, 1, &none, &err), WT_OK);
    assert_true(isnan(none.time));
    assert_int_equal(wt_layer_first_event(NULL, 0, &none, &err), WT_E_ARG);
}

static void refuses(void **state)
{
    (void)state;
    wt_energy_source source = {.n = 1,
                               .wavenumber = (double[]){1e6},
                               .power = (double[]){400},
                               .profile = WT_PROFILE_PERSSON};
    wt_energy_source other = source;
    other.profile = WT_PROFILE_INCOMPRESSIBLE;
    wt_layer_parameters p = wt_layer_defaults();
    wt_layer_steady_state b;
    wt_error err = WT_ERROR_INIT;
    const double time = 1;
    wt_layer_section s;
    p.pressure = 4e5;
    p.velocity = 5e-3;
    p.critical_energy = (double)NAN;
    assert_int_equal(wt_layer_steady_state_compute(&source, &p, &b, &err), WT_E_RANGE);
    p.critical_energy = 2e10;
    const wt_layer_load mixed[] = {{&source, p, 1}, {&other, p, 1}};
    assert_int_equal(wt_layer_sections(mixed, 2, &time, 1, &s, &err), WT_E_ARG);
    assert_non_null(strstr(err.message, "profile"));
    const wt_layer_load endless[] = {{&source, p, (double)INFINITY}};
    assert_int_equal(wt_layer_sections(endless, 1, &time, 1, &s, &err), WT_E_RANGE);
    assert_int_equal(wt_layer_sections(NULL, 0, &time, 1, &s, &err), WT_E_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(events_in_parts),
        cmocka_unit_test(worn_off_and_back),
        cmocka_unit_test(numeric_cases),
        cmocka_unit_test(restart_changes_nothing),
        cmocka_unit_test(severity_off_changes_nothing),
        cmocka_unit_test(errors_of_the_power),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
