/* Every expected number of the modified layer in the shared reference data, if they exist, is
 * expected by a numeric case of the same name, or is in a short list with its reason.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "weartrack/layer.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REFERENCE WT_SHARED_DIR "/reference/"
#define NUMERIC WT_SOURCE_DIR "/tests/numeric/"

enum { WORD = 64, DEPTH = 16 };

/* ---- numbers without a numeric case ---------------------------------------------------------- */

typedef struct left_out {
    const char *id, *key, *why; /* a NULL key means the whole case */
    size_t met;
} left_out;

#define ITSELF "how well the reference agrees with itself"
#define SHARE "the share of time: under Hertz's pressure the effective duty stands in its place"
#define POWER_LAW                                                                                  \
    "of a power law, whose exponent nobody gives: the program has the limit for small ones"
#define CLOSURE "of bonds over a barrier, which the program does not have"
#define GIVEN "given, in other words"
#define BANDS "of buried bands and their history, which the program does not have"
#define FEEDBACK "of a layer that changes the energy that forms it, which the program does not have"
#define SEVERITY "of a wear rate that grows with the power, which the program does not have"
#define RUNNING_IN "of friction in running-in, which validate predicts for a record"
/* Damage along loads is that of bands; other cases test the limit without wear. */
#define BANDS_OF(id)                                                                               \
    {id, "edges_m", BANDS, 0}, {id, "depth_m", BANDS, 0},                                          \
    {                                                                                              \
        id, "t_s", BANDS, 0                                                                        \
    }
#define STEPS_OF(id)                                                                               \
    {id, "transport_edges_m", BANDS, 0}, {id, "damage_at_1um", BANDS, 0},                          \
    {                                                                                              \
        id, "worn_m", BANDS, 0                                                                     \
    }
#define RUNNING_IN_OF(id)                                                                          \
    {id, "tau_layer_Pa", RUNNING_IN, 0}, {id, "mu_start", RUNNING_IN, 0},                          \
        {id, "mu_end_switch", RUNNING_IN, 0}, {id, "mu_end_saturating", RUNNING_IN, 0},            \
        {id, "mu_switch_ode", RUNNING_IN, 0}, {id, "mu_switch_transport", RUNNING_IN, 0},          \
        {id, "mu_saturating_ode", RUNNING_IN, 0},                                                  \
    {                                                                                              \
        id, "mu_saturating_transport", RUNNING_IN, 0                                               \
    }

static left_out list[] = {
    {"K_layered_modulus", "interp_E_eff_over_El",
     "a rule in the place of the layered half-space, of which the theory says: do not use it", 0},
    {"M_rate_to_frequency", "exact_omega_t_h2_n0.05", POWER_LAW, 0},
    {"M_rate_to_frequency", "exact_omega_t_h2_n0.1", POWER_LAW, 0},
    {"M_rate_to_frequency", "exact_omega_t_h2_n0.2", POWER_LAW, 0},
    {"Q_step_in_severity", "sliding_distance_stage1_m", GIVEN, 0},
    {"R_pin_on_disc", "duty_2a_over_2pi_r", SHARE, 0},
    {"pin_on_disc_hertz", "time_share", SHARE, 0},
    {"act_open", NULL, CLOSURE, 0},
    {"act_clamped", NULL, CLOSURE, 0},
    {"act_clamped_overflow", NULL, CLOSURE, 0},
    {"act_shelf_life", NULL, CLOSURE, 0},
    {"act_contact_value", NULL, CLOSURE, 0},
    {"activated_temperature_steps", NULL, CLOSURE, 0},
    {"J_friction", NULL, "of cracks at the rims of the contacts, which the program does not have",
     0},
    {"velocity_ramp", "t_s", GIVEN ": as times at the last velocity that make the same distance",
     0},
    {"velocity_ramp", "sliding_distance_m", GIVEN ": likewise", 0},
    {"loop_soft", NULL, FEEDBACK, 0},
    {"loop_stiff_bistable", NULL, FEEDBACK, 0},
    {"loop_stiff_three_roots", NULL, FEEDBACK, 0},
    {"loop_own_viscoelasticity", NULL, FEEDBACK, 0},
    {"running_in_full", NULL, FEEDBACK, 0},
    {"severity_m1.5", NULL, SEVERITY, 0},
    {"severity_three_waves", NULL, SEVERITY, 0},
    {"window_in_velocity", NULL, SEVERITY, 0},
    BANDS_OF("buried_with_wear"),
    BANDS_OF("two_places_m0.3"),
    BANDS_OF("two_places_m0.4"),
    BANDS_OF("two_waves"),
    BANDS_OF("two_waves_with_wear"),
    BANDS_OF("two_waves_with_more_wear"),
    STEPS_OF("steps_pressure_velocity_temperature"),
    STEPS_OF("steps_layer_removed_and_back"),
    RUNNING_IN_OF("running_in_rules"),
    RUNNING_IN_OF("running_in_rules_three_waves"),
    {"ball_prony_slow", "weighted_difference_of_two_rules", ITSELF, 0},
    {"ball_prony_fast", "weighted_difference_of_two_rules", ITSELF, 0},
    {"ball_zener", "weighted_difference_of_two_rules", ITSELF, 0},
};
enum { LIST = sizeof list / sizeof *list };

static bool is_left_out(const char *id, const char *key)
{
    for (size_t i = 0; i < LIST; i++)
        if (strcmp(list[i].id, id) == 0 && (list[i].key == NULL || strcmp(list[i].key, key) == 0))
            return ++list[i].met > 0;
    return false;
}

/* ---- numbers of numeric cases ---------------------------------------------------------------- */

typedef struct expectation {
    char id[WORD];
    double value;
} expectation;
enum { EXPECTED = 8192 };
static expectation expected[EXPECTED];
static size_t n_expected;

static void read_expected(const char *name)
{
    char path[512], line[4096], id[WORD] = "";
    snprintf(path, sizeof path, NUMERIC "%s.txt", name);
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    while (fgets(line, sizeof line, in) != NULL) {
        if (sscanf(line, "case %63s", id) == 1 || strncmp(line, "expect ", 7) != 0)
            continue;
        char *rest = NULL;
        (void)strtok_r(line, " \n", &rest);
        (void)strtok_r(NULL, " \n", &rest);
        for (const char *word; (word = strtok_r(NULL, " \n", &rest)) != NULL;) {
            assert_true(n_expected < EXPECTED);
            expectation *const e = &expected[n_expected++];
            memcpy(e->id, id, sizeof id);
            e->value = strtod(word, NULL);
        }
    }
    fclose(in);
}

/* A case of the reference may correspond to several here: NAME_0, NAME_ball. */
static bool is_of(const char *name, const char *id)
{
    const size_t n = strlen(id);
    return strncmp(name, id, n) == 0 && (name[n] == '\0' || name[n] == '_');
}

/* SI units there; here the units of the key. */
static bool is_expected(const char *id, const char *key, double value)
{
    const double unit = strstr(key, "mm3_per_Nm") != NULL ? 1e-9
                        : strcmp(id, "N_statistics") == 0 ? 1e6
                                                          : 1;
    for (size_t i = 0; i < n_expected; i++)
        if (is_of(expected[i].id, id) &&
            (fabs(expected[i].value - value) <= 1e-15 * fabs(value) ||
             fabs(expected[i].value - unit * value) <= 1e-15 * fabs(unit * value)))
            return true;
    return false;
}

/* ---- the reference --------------------------------------------------------------------------- */

/* Simple JSON parser without escapes. */
typedef struct place {
    bool list;
    char key[WORD]; /* "": of the next word */
} place;
typedef struct walk {
    const char *at;
    size_t depth;
    place place[DEPTH];
    char id[WORD]; /* of the case */
    size_t numbers, unknown;
} walk;

/* The innermost name. */
static const char *key_of(const walk *w)
{
    size_t i = w->depth;
    while (i > 1 && w->place[i - 1].list)
        i--;
    return w->place[i - 1].key;
}

static void take_word(walk *w)
{
    const char *const end = strchr(++w->at, '"');
    char word[WORD];
    assert_non_null(end);
    snprintf(word, sizeof word, "%.*s", (int)(end - w->at), w->at);
    place *const here = &w->place[w->depth - 1];
    if (!here->list && here->key[0] == '\0')
        memcpy(here->key, word, sizeof word);
    else if (w->depth == 3 && strcmp(here->key, "id") == 0)
        memcpy(w->id, word, sizeof word);
    w->at = end + 1;
}

static void take_number(walk *w)
{
    char *end = NULL;
    const bool yes = strncmp(w->at, "true", 4) == 0, no = strncmp(w->at, "false", 5) == 0;
    const double value = yes || no ? (double)yes : strtod(w->at, &end);
    if (yes || no)
        w->at += yes ? 4 : 5;
    else if (end == w->at)
        fail_msg("%s: not understood: %.20s", w->id, w->at);
    else
        w->at = end;
    if (w->depth < 4 || strcmp(w->place[2].key, "expected") != 0)
        return;
    w->numbers++;
    if (is_left_out(w->id, key_of(w)) || is_expected(w->id, key_of(w), value))
        return;
    w->unknown++;
    print_error("%s, %s: no numeric case expects %.17g\n", w->id, key_of(w), value);
}

static void take(walk *w)
{
    switch (*w->at) {
    case '{':
    case '[':
        assert_true(w->depth < DEPTH);
        w->place[w->depth++] = (place){.list = *w->at++ == '['};
        return;
    case '}':
    case ']':
        assert_true(w->depth > 0);
        w->depth--;
        w->at++;
        return;
    case ',':
        w->place[w->depth - 1].key[0] = '\0';
        w->at++;
        return;
    case '"':
        take_word(w);
        return;
    case ':':
    case ' ':
    case '\n':
        w->at++;
        return;
    default:
        take_number(w);
    }
}

static walk walk_through(const char *path)
{
    enum { ROOM = 1 << 18 };
    FILE *in = fopen(path, "r");
    if (in == NULL)
        skip();
    char *text = calloc(ROOM, 1);
    assert_non_null(text);
    const size_t n = fread(text, 1, ROOM - 1, in);
    assert_true(n > 1000 && n < ROOM - 1);
    fclose(in);
    walk w = {.at = text};
    while (*w.at != '\0')
        take(&w);
    free(text);
    assert_int_equal(w.depth, 0);
    return w;
}

static void every_number_is_expected(void **state)
{
    (void)state;
    static const char *const files[] = {"layer", "layer-beyond", "layer-data", "layer-around",
                                        "group_comparison"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        read_expected(files[i]);
    const walk first = walk_through(REFERENCE "tribolayer.json"),
               second = walk_through(REFERENCE "tribolayer-beyond.json");
    assert_true(first.numbers >= 334 && second.numbers >= 1723);
    assert_int_equal(first.unknown + second.unknown, 0);
    for (size_t i = 0; i < LIST; i++)
        if (list[i].met == 0)
            fail_msg("%s, %s is left out for nothing", list[i].id,
                     list[i].key != NULL ? list[i].key : "all");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_number_is_expected)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
